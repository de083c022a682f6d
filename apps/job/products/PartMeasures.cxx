// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PartMeasures.h"

#include "LengthHistogram.h"
#include "SurfaceBlocks.h"
#include "SurfaceReader.h"
#include "SurveySummary.h"

#include "itkMedialVoxelVector3.h"

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

  const LengthHistogram &
  GetHistogram() const
  {
    return m_Histogram;
  }

  ThicknessOfSurface
  Summarize() const
  {
    ThicknessOfSurface thickness;
    static_cast<ThicknessStatistics &>(thickness) = MakeStatistics(m_Histogram);
    thickness.area = static_cast<double>(m_Histogram.GetTotal()) * m_Unit;
    thickness.bins = MakeBins(m_Histogram, m_Unit);
    return thickness;
  }

private:
  double          m_Unit;
  LengthHistogram m_Histogram;
};

} // namespace

PartSummary
MeasurePart(const SurfaceSpool &                surface,
            const SurfaceArray *                rays,
            const VolumeGeometry &              geometry,
            const std::function<void(double)> & progress)
{
  SurfaceReader reader(surface, progress);
  reader.SetNumberOfPasses(0, 1);
  SurfaceBlocks<float> lengths(surface.GetNumberOfVertices(),
                               [rays](std::uint64_t first, std::uint64_t count, std::vector<float> & numbers) {
                                 rays->Read(first, count, numbers);
                               });
  const Point          reference{ geometry.origin[0], geometry.origin[1], geometry.origin[2] };
  AreaByThickness      thickness(geometry);
  AreaByThickness      rayThickness(geometry);
  PartSummary          summary;
  double               volume = 0.0;
  reader.ForEachFace([&](std::uint64_t, const SurfaceFace & face) {
    std::array<Point, 3> corners{};
    std::array<float, 3> values{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const SurfaceReader::Vertex & vertex = reader.GetVertex(face.vertices[i]);
      corners[i] = itk::MedialVoxelSubtract(vertex.position, reference);
      values[i] = vertex.thickness;
    }
    const Point  normal = itk::MedialVoxelCross(itk::MedialVoxelSubtract(corners[1], corners[0]),
                                               itk::MedialVoxelSubtract(corners[2], corners[0]));
    const double area = 0.5 * itk::MedialVoxelNorm(normal);
    summary.area += area;
    summary.capArea += face.isCap ? area : 0.0;
    volume += itk::MedialVoxelDot(corners[0], normal) / 6.0;
    for (std::size_t i = 0; i < 3 && !face.isCap; ++i)
    {
      thickness.Add(values[i], area / 3.0);
      if (rays != nullptr)
      {
        rayThickness.Add(lengths.Get(face.vertices[i]), area / 3.0);
      }
    }
  });
  summary.vertices = surface.GetNumberOfVertices();
  summary.triangles = surface.GetNumberOfTriangles();
  summary.volume = volume;
  summary.thickness = thickness.Summarize();
  if (rays != nullptr)
  {
    summary.rays = rayThickness.Summarize();
  }
  const LengthHistogram & histogram = thickness.GetHistogram();
  if (histogram.GetTotal() > 0)
  {
    summary.colorRange = { histogram.GetPercentile(FirstColorPercent), histogram.GetPercentile(LastColorPercent) };
  }
  return summary;
}

} // end namespace medialvoxel
