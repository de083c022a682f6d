// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PartMeasures.h"

#include "LengthHistogram.h"
#include "RecordBlocks.h"
#include "MeshReader.h"
#include "OrderedWork.h"
#include "SurveySummary.h"

#include "itkMedialVoxelVector3.h"
#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace medialvoxel
{
namespace
{

using Point = itk::MedialVoxelVector3;

constexpr double BinsPerVoxel = 64.0;
constexpr double UnitsPerFace = 1048576.0; ///< of area: whole numbers do not depend on their order

// The colors of pictures, which a few single vertices must not decide.
constexpr double FirstColorPercent = 1.0;
constexpr double LastColorPercent = 99.0;

double
GetSmallestSpacing(const VolumeGeometry & geometry)
{
  return *std::min_element(geometry.spacing.begin(), geometry.spacing.end());
}

/** \class AreaByThickness
 * \brief Area for each thickness. */
class AreaByThickness
{
public:
  explicit AreaByThickness(const VolumeGeometry & geometry)
    : m_Unit(GetSmallestSpacing(geometry) * GetSmallestSpacing(geometry) / UnitsPerFace)
    , m_Histogram(GetSmallestSpacing(geometry) / BinsPerVoxel)
  {}

  void
  Add(float thickness, double area)
  {
    if (std::isfinite(thickness))
    {
      m_Histogram.Add(m_Histogram.GetBin(thickness), static_cast<std::uint64_t>(std::llround(area / m_Unit)));
    }
  }

  void
  Add(const AreaByThickness & other)
  {
    m_Histogram.Add(other.m_Histogram);
  }

  const LengthHistogram &
  GetHistogram() const
  {
    return m_Histogram;
  }

  Json
  Summarize(const std::uint64_t unknownVertices) const
  {
    const bool isKnown = m_Histogram.GetTotal() > 0;
    return { { "unknown_vertices", unknownVertices },
             { "area", static_cast<double>(m_Histogram.GetTotal()) * m_Unit },
             { "mean", isKnown ? Json(m_Histogram.GetMean()) : Json(nullptr) },
             { "standard_deviation", isKnown ? Json(m_Histogram.GetStandardDeviation()) : Json(nullptr) },
             { "percentiles", MakePercentiles(m_Histogram, isKnown) },
             { "histogram", MakeBins(m_Histogram, m_Unit) } };
  }

private:
  double          m_Unit;
  LengthHistogram m_Histogram;
};

/** Faces that a thread measures. */
constexpr std::uint64_t FacesAtATime = std::uint64_t{ 1 } << 15;

/** Of some faces. */
struct Measures
{
  explicit Measures(const VolumeGeometry & geometry)
    : thickness(geometry)
    , rayThickness(geometry)
  {}

  void
  Add(const Measures & other)
  {
    thickness.Add(other.thickness);
    rayThickness.Add(other.rayThickness);
    wholeArea += other.wholeArea;
    capArea += other.capArea;
    volume += other.volume;
  }

  AreaByThickness thickness;
  AreaByThickness rayThickness;
  double          wholeArea{ 0.0 };
  double          capArea{ 0.0 };
  double          volume{ 0.0 };
};

Measures
MeasureFaces(const MeshSpool &      surface,
             const std::uint64_t    first,
             const std::uint64_t    count,
             const VertexValues *   rays,
             const VolumeGeometry & geometry)
{
  MeshReader            reader(surface, {});
  RecordBlocks<float>   lengths(surface.GetNumberOfVertices(),
                              [rays](std::uint64_t begin, std::uint64_t number, std::vector<float> & numbers) {
                                rays->Read(begin, number, numbers);
                              });
  const Point           reference{ geometry.origin[0], geometry.origin[1], geometry.origin[2] };
  std::vector<MeshFace> faces;
  Measures              measures(geometry);
  surface.ReadFaces(first, count, faces);
  for (const MeshFace & face : faces)
  {
    std::array<Point, 3> corners{};
    std::array<float, 3> values{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const MeshReader::Vertex & vertex = reader.GetVertex(face.vertices[i]);
      corners[i] = itk::MedialVoxelSubtract(vertex.position, reference);
      values[i] = vertex.thickness;
    }
    const Point  normal = itk::MedialVoxelCross(itk::MedialVoxelSubtract(corners[1], corners[0]),
                                               itk::MedialVoxelSubtract(corners[2], corners[0]));
    const double area = 0.5 * itk::MedialVoxelNorm(normal);
    measures.wholeArea += area;
    measures.capArea += face.isCap ? area : 0.0;
    measures.volume += itk::MedialVoxelDot(corners[0], normal) / 6.0;
    for (std::size_t i = 0; i < 3 && !face.isCap; ++i)
    {
      measures.thickness.Add(values[i], area / 3.0);
      if (rays != nullptr)
      {
        measures.rayThickness.Add(lengths.Get(face.vertices[i]), area / 3.0);
      }
    }
  }
  return measures;
}

/** Sums of whole groups of faces in their order, which threads do not change. */
Measures
MeasureFaces(const MeshSpool &                   surface,
             const VertexValues *                rays,
             const VolumeGeometry &              geometry,
             const std::function<void(double)> & progress)
{
  const std::uint64_t faces = surface.GetNumberOfFaces();
  Measures            sum(geometry);
  OrderedWork<Measures>::Run((faces + FacesAtATime - 1) / FacesAtATime,
                             itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads(),
                             [&](std::uint64_t group, const std::function<void()> &) {
                               const std::uint64_t first = group * FacesAtATime;
                               return MeasureFaces(
                                 surface, first, std::min(FacesAtATime, faces - first), rays, geometry);
                             },
                             [&](std::uint64_t, Measures && measures) { sum.Add(measures); },
                             [&progress] { progress(0.0); });
  return sum;
}

} // namespace

Json
MeasurePart(const MeshSpool &                   surface,
            const VertexValues *                rays,
            const VolumeGeometry &              geometry,
            const PartFacts &                   facts,
            const std::function<void(double)> & progress)
{
  const Measures          measures = MeasureFaces(surface, rays, geometry, progress);
  const LengthHistogram & histogram = measures.thickness.GetHistogram();
  Json                    colors;
  if (histogram.GetTotal() > 0)
  {
    colors = { histogram.GetPercentile(FirstColorPercent), histogram.GetPercentile(LastColorPercent) };
  }
  Json rayJson;
  if (rays != nullptr)
  {
    rayJson = measures.rayThickness.Summarize(facts.unansweredRays.GetTotal());
    rayJson["unanswered"] = { { "leave_volume", facts.unansweredRays.leaveVolume },
                              { "too_long", facts.unansweredRays.tooLong },
                              { "unknown", facts.unansweredRays.unknown } };
  }
  return { { "vertices", surface.GetNumberOfVertices() },
           { "triangles", surface.GetNumberOfTriangles() },
           { "placed_by", facts.usesGrayValues ? "values" : "object" },
           { "area", measures.wholeArea },
           { "cap_area", measures.capArea },
           { "volume", facts.isOpen ? Json(nullptr) : Json(measures.volume) },
           { "color_range", colors },
           { "thickness", measures.thickness.Summarize(facts.unknownVertices) },
           { "ray_thickness", rayJson } };
}

} // end namespace medialvoxel
