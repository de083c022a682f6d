// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetCoarsening.h"

#include "OrderedWork.h"
#include "MeshPartition.h"
#include "MeshReader.h"

#include "itkMedialVoxelSheetDistances.h"
#include "itkMedialVoxelWallFitting.h"
#include "itkMedialVoxelSheetPart.h"

#include <unordered_map>

namespace medialvoxel
{
namespace
{

using Index = itk::MedialVoxelSheet::Index;
using Check = std::function<void()>;

/** Faces of a part at most. */
constexpr std::uint64_t MostFaces = std::uint64_t{ 1 } << 13;

/** Memory of readers and the lattice of parts. */
constexpr std::uint64_t BaseMemory = std::uint64_t{ 40 } << 20;

std::function<void(double)>
ToProgress(const Check & check)
{
  return [&check](double) { check(); };
}

/** The group of a vertex whose number is before the next group. */
std::uint64_t
GetGroup(const std::vector<std::uint64_t> & first, const std::uint64_t number)
{
  return static_cast<std::uint64_t>(std::upper_bound(first.begin(), first.end(), number) - first.begin()) - 1;
}

/** Of the sides of elements, 0 without any. */
double
GetMeanSide(const itk::MedialVoxelRemeshedSheet & sheet)
{
  double      sum = 0.0;
  std::size_t number = 0;
  for (const itk::MedialVoxelShellElement & element : sheet.elements)
  {
    for (unsigned int k = 0; k < element.numberOfCorners; ++k, ++number)
    {
      const auto & a = sheet.points[element.corners[k]];
      const auto & b = sheet.points[element.corners[(k + 1) % element.numberOfCorners]];
      sum += itk::MedialVoxelNorm(itk::MedialVoxelSubtract(a, b));
    }
  }
  return number > 0 ? sum / static_cast<double>(number) : 0.0;
}

} // namespace

/** Faces of a group, and all of their vertices. */
struct SheetCoarsening::Part
{
  itk::MedialVoxelSheet      sheet;
  std::vector<std::uint64_t> numbers; ///< of the vertices in the surface
  std::vector<std::uint32_t> objects;
};

SheetCoarsening::SheetCoarsening(std::unique_ptr<MeshSpool> surface, const SheetRemeshing & remeshing)
  : m_Remeshing(remeshing)
{
  MeshReader          reader(*surface, remeshing.progress);
  const MeshPartition partition(reader, MostFaces);
  m_Grouped = SortMesh(
    std::move(surface),
    [&partition](const MeshSpool::Vertex & vertex) { return partition.GetPart(vertex); },
    partition.GetNumberOfParts() - 1,
    remeshing.scratchFolder,
    remeshing.progress);
  this->FindShared();
}

void
SheetCoarsening::FindShared()
{
  MeshReader reader(*m_Grouped.surface, m_Remeshing.progress);
  reader.ForEachFace([&](const std::uint64_t number, const MeshFace & face) {
    const std::uint64_t part = GetGroup(m_Grouped.firstFace, number);
    for (unsigned int k = 0; k < face.numberOfVertices; ++k)
    {
      const std::uint64_t vertex = face.vertices[k];
      if (vertex < m_Grouped.firstVertex[part] || vertex >= m_Grouped.firstVertex[part + 1])
      {
        m_Shared.push_back(vertex);
      }
    }
  });
  std::sort(m_Shared.begin(), m_Shared.end());
  m_Shared.erase(std::unique(m_Shared.begin(), m_Shared.end()), m_Shared.end());
}

SheetCoarsening::Part
SheetCoarsening::ReadPart(const std::uint64_t number) const
{
  const MeshSpool &              surface = *m_Grouped.surface;
  const std::uint64_t            first = m_Grouped.firstVertex[number];
  const std::uint64_t            last = m_Grouped.firstVertex[number + 1];
  std::vector<MeshSpool::Vertex> vertices;
  std::vector<MeshFace>          faces;
  surface.ReadVertices(first, last - first, vertices);
  surface.ReadFaces(m_Grouped.firstFace[number], m_Grouped.firstFace[number + 1] - m_Grouped.firstFace[number], faces);

  Part                                     part;
  std::unordered_map<std::uint64_t, Index> places;
  const auto                               add = [&](const std::uint64_t vertex) {
    const auto [found, isNew] = places.emplace(vertex, static_cast<Index>(part.numbers.size()));
    if (isNew)
    {
      std::vector<MeshSpool::Vertex> foreign;
      const bool                     isOwn = vertex >= first && vertex < last;
      if (!isOwn)
      {
        surface.ReadVertices(vertex, 1, foreign);
      }
      const MeshSpool::Vertex & record = isOwn ? vertices[vertex - first] : foreign.front();
      part.numbers.push_back(vertex);
      part.sheet.points.push_back(record.position);
      part.sheet.thickness.push_back(record.thickness);
      part.objects.push_back(record.object);
    }
    return found->second;
  };
  for (const MeshFace & face : faces)
  {
    std::array<Index, 4> corners{};
    std::transform(face.vertices.begin(), face.vertices.begin() + face.numberOfVertices, corners.begin(), add);
    if (face.numberOfVertices == 4)
    {
      part.sheet.AddQuad(corners);
    }
    else
    {
      part.sheet.triangles.push_back({ { corners[0], corners[1], corners[2] } });
    }
  }
  return part;
}

std::unique_ptr<MeshSpool>
SheetCoarsening::Coarsen(std::vector<itk::MedialVoxelWallLeftOut> & wallsLeftOut) const
{
  struct Coarsened
  {
    itk::MedialVoxelCoarsenedPart part;
    Part                          fine; ///< without its sheet
  };
  const MeshSpool & surface = *m_Grouped.surface;
  auto              result = std::make_unique<MeshSpool>(m_Remeshing.scratchFolder, surface.GetPrecision());
  const auto        findShared = [this](const std::uint64_t vertex) {
    return std::lower_bound(m_Shared.begin(), m_Shared.end(), vertex);
  };
  const auto isShared = [&](const std::uint64_t vertex) {
    const auto found = findShared(vertex);
    return found != m_Shared.end() && *found == vertex;
  };

  // Shared vertices come first.
  MeshReader                     reader(surface, {});
  std::vector<MeshSpool::Vertex> vertices;
  for (const std::uint64_t vertex : m_Shared)
  {
    vertices.push_back(reader.GetVertex(vertex));
  }
  result->PutVertices(0, vertices);

  const auto make = [&](const std::uint64_t number, const Check & check) {
    Coarsened coarsened{ {}, this->ReadPart(number) };
    Part &    fine = coarsened.fine;
    fine.sheet.RemoveDuplicates();
    std::vector<bool> shared(fine.numbers.size());
    std::transform(fine.numbers.begin(), fine.numbers.end(), shared.begin(), isShared);
    coarsened.part = itk::MedialVoxelCoarsenPart(std::move(fine.sheet), shared, m_Remeshing.size, ToProgress(check));
    return coarsened;
  };
  const auto take = [&](std::uint64_t, Coarsened && coarsened) {
    const itk::MedialVoxelSheet & sheet = coarsened.part.sheet;
    std::vector<std::uint64_t>    numbers;
    vertices.clear();
    for (std::size_t k = 0; k < sheet.points.size(); ++k)
    {
      const Index         finePoint = coarsened.part.finePoint[k];
      const std::uint64_t vertex = coarsened.fine.numbers[finePoint];
      if (isShared(vertex))
      {
        numbers.push_back(static_cast<std::uint64_t>(findShared(vertex) - m_Shared.begin()));
        continue;
      }
      numbers.push_back(result->GetNumberOfVertices() + vertices.size());
      vertices.push_back({ sheet.points[k], sheet.thickness[k], coarsened.fine.objects[finePoint] });
    }
    result->PutVertices(result->GetNumberOfVertices(), vertices);
    std::vector<MeshFace> faces;
    for (const auto & corners : sheet.triangles)
    {
      MeshFace face;
      face.vertices = { { numbers[corners[0]], numbers[corners[1]], numbers[corners[2]], 0 } };
      face.numberOfVertices = 3;
      faces.push_back(face);
    }
    result->AddFaces(faces);
    itk::MedialVoxelAddWallsLeftOut(coarsened.part.wallsLeftOut, wallsLeftOut);
  };
  OrderedWork<Coarsened>::Run(
    this->GetNumberOfParts(), m_Remeshing.threads, make, take, [this] { m_Remeshing.progress(0.0); });
  return result;
}

void
SheetCoarsening::MeasureDistances(const itk::MedialVoxelRemeshedSheet & coarse,
                                  itk::MedialVoxelRemeshingSummary &    summary) const
{
  itk::MedialVoxelSheetDistances distances(coarse);
  const auto                     check = [this] { m_Remeshing.progress(0.0); };
  struct Measured
  {
    std::vector<double>                                         points;
    std::vector<itk::MedialVoxelSheetDistances::SampleDistance> samples;
  };
  // Samples are near the fine surface nearly always, but for rims that were carried on.
  const double side = GetMeanSide(coarse);
  bool         isFirst = true;
  for (const double within : { side, 4.0 * side, 16.0 * side, itk::MedialVoxelSheetTree::Anywhere })
  {
    if (distances.BeginSamples(within))
    {
      OrderedWork<Measured>::Run(
        this->GetNumberOfParts(),
        m_Remeshing.threads,
        [&](const std::uint64_t number, const Check &) {
          const itk::MedialVoxelSheet part = this->ReadPart(number).sheet;
          return Measured{ isFirst ? distances.MeasurePoints(part) : std::vector<double>{},
                           distances.MeasureSamples(part) };
        },
        [&](std::uint64_t, const Measured & measured) {
          distances.Add(measured.points);
          distances.Add(measured.samples);
        },
        check);
    }
    isFirst = false;
  }
  distances.Summarize(summary);
}

void
SheetCoarsening::FitWalls(itk::MedialVoxelRemeshedSheet &  coarse,
                          const double                     noise,
                          const itk::MedialVoxelRunTasks & runTasks) const
{
  itk::MedialVoxelWallFitting fitting(coarse, noise);
  using Sums = std::vector<itk::MedialVoxelWallFitting::Sums>;
  OrderedWork<Sums>::Run(
    this->GetNumberOfParts(),
    m_Remeshing.threads,
    [&](const std::uint64_t number, const Check &) { return fitting.Measure(this->ReadPart(number).sheet); },
    [&](std::uint64_t, const Sums & sums) { fitting.Add(sums); },
    [this] { m_Remeshing.progress(0.0); });
  coarse.points = fitting.FindPlaces(runTasks);
}

std::uint64_t
SheetCoarsening::GetBytes(const unsigned int threads)
{
  // A part, and results of others that wait, which take a sixth of it each at most.
  return BaseMemory + threads * 2 * MostFaces * itk::MedialVoxelRemeshingBytesPerTriangle() * 4 / 3;
}

} // end namespace medialvoxel
