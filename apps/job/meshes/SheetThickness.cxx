// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetThickness.h"

#include <cmath>

namespace medialvoxel
{
namespace
{

std::optional<double>
GetKnownThickness(MeshReader & reader, std::uint64_t vertex)
{
  const auto thickness = static_cast<double>(reader.GetVertex(vertex).thickness);
  return std::isfinite(thickness) && thickness > 0 ? std::optional<double>(thickness) : std::nullopt;
}

/** A face's thickness, and the level of the corners that it is from. */
struct FaceThickness
{
  std::optional<double> value;
  unsigned int          level;
};

FaceThickness
MeasureFace(MeshReader & reader, const SheetEdges & edges, const MeshFace & face)
{
  constexpr unsigned int            levels = SheetEdges::AtRim + 1;
  std::array<ThicknessSums, levels> sums;
  for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
  {
    const std::uint64_t vertex = face.vertices[corner];
    if (const std::optional<double> thickness = GetKnownThickness(reader, vertex))
    {
      sums[edges.GetLevel(vertex)].Add(0, *thickness);
    }
  }
  const auto best =
    std::find_if(sums.begin(), sums.end(), [](const ThicknessSums & known) { return known.number > 0; });
  const auto level = static_cast<unsigned int>(best - sums.begin());
  return { level < levels ? std::optional<double>(best->GetMean()) : std::nullopt, level };
}

/** Size of the sums of a vertex, in numbers. */
constexpr std::uint64_t NumbersPerVertex = sizeof(ThicknessSums) / 8;

std::uint64_t
GetVerticesAtATime(std::uint64_t keptNumbers)
{
  return std::max(std::uint64_t{ 1 }, keptNumbers / NumbersPerVertex);
}

} // namespace

void
ThicknessSums::Add(double addedArea, double addedThickness)
{
  ++number;
  area += addedArea;
  areaTimesThickness += addedArea * addedThickness;
  thickness += addedThickness;
}

double
ThicknessSums::GetMean() const
{
  return area > 0 ? areaTimesThickness / area : thickness / static_cast<double>(number);
}

SheetEdges::SheetEdges(MeshReader & reader)
  : m_Rims(reader.GetMesh().GetNumberOfVertices())
  , m_Junctions(reader.GetMesh().GetNumberOfVertices())
{
  const auto mark = [](const MeshFace & face, unsigned int sides, std::vector<bool> & marks) {
    for (unsigned int side = 0; side < face.numberOfVertices; ++side)
    {
      if ((sides >> side & 1U) != 0)
      {
        marks[face.vertices[side]] = true;
        marks[face.vertices[(side + 1) % face.numberOfVertices]] = true;
      }
    }
  };
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    mark(face, face.rimEdges, m_Rims);
    mark(face, face.junctionEdges, m_Junctions);
  });
}

std::optional<double>
GetFaceThickness(MeshReader & reader, const SheetEdges & edges, const MeshFace & face)
{
  return MeasureFace(reader, edges, face).value;
}

std::optional<double>
GetCornerThickness(MeshReader & reader, const SheetEdges & edges, const MeshFace & face, unsigned int corner)
{
  const std::uint64_t         vertex = face.vertices[corner];
  const std::optional<double> own = GetKnownThickness(reader, vertex);
  return own && edges.GetLevel(vertex) == SheetEdges::Inside ? own : GetFaceThickness(reader, edges, face);
}

void
ForEachNodeThickness(MeshReader &                                                                       reader,
                     const SheetEdges &                                                                 edges,
                     std::uint64_t                                                                      keptNumbers,
                     const std::function<void(std::uint64_t number, std::optional<double> thickness)> & function)
{
  const std::uint64_t        vertices = reader.GetMesh().GetNumberOfVertices();
  const std::uint64_t        step = GetVerticesAtATime(keptNumbers);
  std::vector<ThicknessSums> ofFaces;
  for (std::uint64_t first = 0; first < vertices; first += step)
  {
    ofFaces.assign(std::min(step, vertices - first), {});
    reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
      const FaceThickness thickness = MeasureFace(reader, edges, face);
      for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
      {
        const std::uint64_t vertex = face.vertices[corner];
        const bool          isAsked = vertex >= first && vertex - first < ofFaces.size();
        if (isAsked && thickness.value &&
            (thickness.level < edges.GetLevel(vertex) || !GetKnownThickness(reader, vertex)))
        {
          ofFaces[vertex - first].Add(face.area, *thickness.value);
        }
      }
    });
    for (std::uint64_t vertex = first; vertex - first < ofFaces.size(); ++vertex)
    {
      const ThicknessSums & sums = ofFaces[vertex - first];
      function(vertex, sums.number > 0 ? std::optional<double>(sums.GetMean()) : GetKnownThickness(reader, vertex));
    }
  }
}

std::uint64_t
CountNodePasses(std::uint64_t numberOfVertices, std::uint64_t keptNumbers)
{
  const std::uint64_t step = GetVerticesAtATime(keptNumbers);
  return (numberOfVertices + step - 1) / step;
}

} // end namespace medialvoxel
