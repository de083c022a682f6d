// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRimLines.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Vector = MedialVoxelVector3;
using Triangle = std::array<Index, 3>;

/** Of the thickness: how far a rim is followed to both sides, where rays start, and how long they may be. */
constexpr double                FollowedOfThickness = 0.5;
constexpr std::array<double, 5> StartsOfThickness{ { -0.25, -0.125, 0.0, 0.125, 0.25 } };
constexpr std::array<double, 3> StartsOfSide{ { -0.33, 0.0, 0.33 } };
constexpr double                LongestOfThickness = 1.0;

/** Of the way to a corner: how much must be inside the part. */
constexpr double InsideOfCorner = 0.85;

bool
IsKnown(const double thickness)
{
  return thickness > 0.0 && std::isfinite(thickness);
}

double
GetMedian(std::vector<double> & values)
{
  assert(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace

MedialVoxelRimLines::MedialVoxelRimLines(const MedialVoxelSheet &          sheet,
                                         const MedialVoxelMeasureRimRays & measure,
                                         const MedialVoxelRunTasks &       runTasks)
  : m_Sheet(sheet)
  , m_Measure(measure)
  , m_Sides(MedialVoxelSortSides(sheet.triangles))
  , m_SidesOf(sheet.points.size())
{
  this->FindRims();
  const auto forEach = [&](const auto & find) {
    MedialVoxelForEach(runTasks, m_Rims.size(), [&](const std::size_t number) { find(number); });
  };
  forEach([this](const std::size_t number) { this->FindWall(m_Rims[number]); });
  forEach([this](const std::size_t number) { this->FindLine(number); });
  forEach([this](const std::size_t number) {
    RimSide & side = m_Rims[number];
    side.length = m_Measure && IsKnown(side.thickness) ? this->MeasureLength(side) : 0.0;
  });
  for (RimSide & side : m_Rims)
  {
    m_Summary.withoutSurface += side.length > 0.0 ? 0 : 1;
    side.length = side.length > 0.0 ? side.length : side.thickness / 2.0;
  }
  forEach([this](const std::size_t number) { this->FindEdge(number); });
}

void
MedialVoxelRimLines::FindRims()
{
  for (std::size_t first = 0, last = 0; first < m_Sides.size(); first = last)
  {
    while (last < m_Sides.size() && m_Sides[first] == m_Sides[last])
    {
      ++last;
    }
    if (last - first == 1)
    {
      const MedialVoxelSheetSide & side = m_Sides[first];
      m_SidesOf[side.low].push_back(m_Rims.size());
      m_SidesOf[side.high].push_back(m_Rims.size());
      m_Rims.push_back({ side.low, side.high, side.triangle });
      ++m_Summary.sides;
      m_Summary.rimLength += MedialVoxelNorm(MedialVoxelSubtract(PointOf(side.low), PointOf(side.high)));
    }
  }
}

void
MedialVoxelRimLines::AppendNeighbors(const Index triangle, std::vector<Index> & found) const
{
  const Triangle & corners = m_Sheet.triangles[triangle];
  for (unsigned int k = 0; k < 3; ++k)
  {
    const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
    const auto [first, last] = std::equal_range(m_Sides.begin(), m_Sides.end(), MedialVoxelSheetSide{ low, high, 0 });
    for (auto side = first; last - first == 2 && side != last; ++side)
    {
      if (std::find(found.begin(), found.end(), side->triangle) == found.end())
      {
        found.push_back(side->triangle);
      }
    }
  }
}

std::vector<Index>
MedialVoxelRimLines::FindNear(const RimSide & side, const double distance) const
{
  std::vector<Index> found(1, side.triangle);
  const Vector       middle = this->MiddleOf(side);
  for (std::size_t next = 0; next < found.size(); ++next)
  {
    const Triangle & corners = m_Sheet.triangles[found[next]];
    if (next == 0 || std::any_of(corners.begin(), corners.end(), [&](const Index point) {
          return MedialVoxelNorm(MedialVoxelSubtract(this->PointOf(point), middle)) < distance;
        }))
    {
      this->AppendNeighbors(found[next], found);
    }
  }
  return found;
}

void
MedialVoxelRimLines::FindWall(RimSide & side) const
{
  double most = 0.0;
  for (const Index point : m_Sheet.triangles[side.triangle])
  {
    most = IsKnown(m_Sheet.thickness[point]) ? std::max<double>(most, m_Sheet.thickness[point]) : most;
  }
  const Vector        own = MedialVoxelTriangleNormal(this->CornersOf(m_Sheet.triangles[side.triangle]));
  std::vector<double> inside;
  for (const Index triangle : this->FindNear(side, most))
  {
    const Vector normal = MedialVoxelTriangleNormal(this->CornersOf(m_Sheet.triangles[triangle]));
    side.normal = MedialVoxelAddScaled(side.normal, normal, MedialVoxelDot(normal, own) < 0.0 ? -1.0 : 1.0);
    for (const Index point : m_Sheet.triangles[triangle])
    {
      if (m_SidesOf[point].empty() && IsKnown(m_Sheet.thickness[point]))
      {
        inside.push_back(m_Sheet.thickness[point]);
      }
    }
  }
  side.normal = MedialVoxelNormalized(side.normal);
  side.thickness = inside.empty() ? most : GetMedian(inside);
}

void
MedialVoxelRimLines::FindLine(const std::size_t number)
{
  Vector along{};
  this->FollowLine(number, FollowedOfThickness, [&](const RimSide & side, const bool turns) {
    along = MedialVoxelAddScaled(
      along, MedialVoxelSubtract(this->PointOf(side.b), this->PointOf(side.a)), turns ? -1.0 : 1.0);
  });
  RimSide & side = m_Rims[number];
  side.outward = MedialVoxelNormalized(MedialVoxelCross(along, side.normal));
  const Triangle & corners = m_Sheet.triangles[side.triangle];
  for (const Index point : corners)
  {
    if (point != side.a && point != side.b &&
        MedialVoxelDot(MedialVoxelSubtract(this->PointOf(point), this->MiddleOf(side)), side.outward) > 0.0)
    {
      side.outward = MedialVoxelAddScaled({}, side.outward, -1.0);
    }
  }
}

double
MedialVoxelRimLines::MeasureLength(const RimSide & side) const
{
  const Vector       middle = this->MiddleOf(side);
  const Vector       along = MedialVoxelSubtract(this->PointOf(side.b), this->PointOf(side.a));
  MedialVoxelRimRays rays;
  rays.direction = side.outward;
  rays.most = LongestOfThickness * side.thickness;
  for (const double height : StartsOfThickness)
  {
    for (const double share : StartsOfSide)
    {
      rays.starts.push_back(
        MedialVoxelAddScaled(MedialVoxelAddScaled(middle, along, share), side.normal, height * side.thickness));
    }
  }
  std::vector<double> lengths = m_Measure(rays);
  lengths.erase(
    std::remove_if(lengths.begin(), lengths.end(), [](const double length) { return !std::isfinite(length); }),
    lengths.end());
  return 2 * lengths.size() > rays.starts.size() ? GetMedian(lengths) : 0.0;
}

void
MedialVoxelRimLines::FindEdge(const std::size_t number)
{
  RimSide & own = m_Rims[number];
  double    sum = 0.0;
  double    weights = 0.0;
  this->FollowLine(number, FollowedOfThickness, [&](const RimSide & side, bool) {
    const double weight = MedialVoxelNorm(MedialVoxelSubtract(this->PointOf(side.b), this->PointOf(side.a)));
    sum += weight * (MedialVoxelDot(this->MiddleOf(side), own.outward) + side.length);
    weights += weight;
  });
  own.edge = weights > 0.0 ? sum / weights : 0.0;
}

double
MedialVoxelRimLines::GetLineLength(const std::size_t number) const
{
  double sum = 0.0;
  this->FollowLine(number, 1.0, [&](const RimSide & side, bool) {
    sum += MedialVoxelNorm(MedialVoxelSubtract(this->PointOf(side.b), this->PointOf(side.a)));
  });
  return sum;
}

double
MedialVoxelRimLines::FindMost(const Index point, const std::vector<double> & values, const double slope) const
{
  double most = m_SidesOf[point].size() == 2 ? 0.0 : values[point];
  for (std::size_t k = 0; m_SidesOf[point].size() == 2 && k < 2; ++k)
  {
    double      ofSide = values[point];
    double      way = 0.0;
    Index       next = point;
    std::size_t number = m_SidesOf[point][k];
    do
    {
      const RimSide & side = m_Rims[number];
      way += slope * MedialVoxelNorm(MedialVoxelSubtract(this->PointOf(side.b), this->PointOf(side.a)));
      next = side.a == next ? side.b : side.a;
      ofSide = m_SidesOf[next].size() == 2 ? std::min(ofSide, values[next] + way) : ofSide;
      number = m_SidesOf[next][m_SidesOf[next][0] == number ? m_SidesOf[next].size() - 1 : 0];
    } while (m_SidesOf[next].size() == 2 && next != point && way < ofSide);
    most = std::max(most, ofSide);
  }
  return most;
}

bool
MedialVoxelRimLines::IsInside(const Vector & start, const Vector & place) const
{
  const Vector way = MedialVoxelSubtract(place, start);
  const double length = MedialVoxelNorm(way);
  const auto   lengths =
    m_Measure ? m_Measure({ { start }, MedialVoxelNormalized(way), length }) : std::vector<double>(1, length);
  return !(lengths[0] < InsideOfCorner * length);
}

float
MedialVoxelRimLines::FindThickness(const Index point) const
{
  double sum = 0.0;
  double number = 0.0;
  for (const std::size_t side : m_SidesOf[point])
  {
    sum += m_Rims[side].thickness;
    number += IsKnown(m_Rims[side].thickness) ? 1.0 : 0.0;
  }
  return number > 0.0 ? static_cast<float>(sum / number) : m_Sheet.thickness[point];
}

} // end namespace itk
