// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetDistances.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Vector = MedialVoxelVector3;
using Triangle = MedialVoxelSheetTree::Triangle;

/** Distances whose single precision numbers agree in these bits are one class. */
constexpr unsigned int BitsOfClass = 13;

constexpr double MostShare = 0.99;

/** Samples of neighboring elements, few enough that their box is small. */
constexpr std::size_t SamplesOfGroup = 256;

/** Normals of elements of a bend turn by more than 30 degrees. */
constexpr double CosineOfBend = 0.866;

std::uint32_t
GetClass(const double distance)
{
  const auto    value = static_cast<float>(distance);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits >> BitsOfClass;
}

/** The largest distance of a class, nearly. */
double
GetDistance(const std::uint32_t number)
{
  const std::uint32_t bits = ((number + 1) << BitsOfClass) - 1;
  float               value = 0.0F;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

double
GetArea(const std::array<Vector, 3> & corners)
{
  return MedialVoxelNorm(MedialVoxelTriangleNormal(corners)) / 2.0;
}

/** Of each point, whether it is on a rim, a junction, or a side where the normals of elements turn. */
std::vector<bool>
FindLines(const MedialVoxelRemeshedSheet & sheet)
{
  struct Side
  {
    Index  low;
    Index  high;
    Vector normal;
  };
  std::vector<Side> sides;
  for (const MedialVoxelShellElement & element : sheet.elements)
  {
    const unsigned int number = element.numberOfCorners;
    const auto         at = [&](const unsigned int k) { return sheet.points[element.corners[k % number]]; };
    Vector             normal{};
    for (unsigned int k = 2; k < number; ++k)
    {
      normal = MedialVoxelAddScaled(normal, MedialVoxelTriangleNormal({ { at(0), at(k - 1), at(k) } }), 1.0);
    }
    for (unsigned int k = 0; k < number; ++k)
    {
      const auto [low, high] = std::minmax(element.corners[k], element.corners[(k + 1) % number]);
      sides.push_back({ low, high, normal });
    }
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side & a, const Side & b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  std::vector<bool> isOnLine(sheet.points.size());
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && sides[first].low == sides[last].low && sides[first].high == sides[last].high)
    {
      ++last;
    }
    if (last - first != 2 || std::abs(MedialVoxelCosine(sides[first].normal, sides[first + 1].normal)) < CosineOfBend)
    {
      isOnLine[sides[first].low] = isOnLine[sides[first].high] = true;
    }
  }
  return isOnLine;
}

} // namespace

void
MedialVoxelDistanceHistogram::Add(const double distance)
{
  const std::uint32_t number = GetClass(distance);
  if (number >= m_Counts.size())
  {
    m_Counts.resize(number + std::size_t{ 1 });
  }
  ++m_Counts[number];
  ++m_Number;
  m_Sum += distance;
  m_Largest = std::max(m_Largest, distance);
}

MedialVoxelRemeshingSummary::Distances
MedialVoxelDistanceHistogram::Summarize() const
{
  MedialVoxelRemeshingSummary::Distances result;
  if (m_Number > 0)
  {
    const double  wanted = MostShare * static_cast<double>(m_Number);
    double        found = 0.0;
    std::uint32_t number = 0;
    while (found + static_cast<double>(m_Counts[number]) < wanted)
    {
      found += static_cast<double>(m_Counts[number++]);
    }
    result.mean = m_Sum / static_cast<double>(m_Number);
    result.largest = m_Largest;
    result.most = std::min(GetDistance(number), m_Largest);
  }
  return result;
}

MedialVoxelSheetDistances::MedialVoxelSheetDistances(const MedialVoxelRemeshedSheet & sheet)
{
  std::vector<Triangle>   triangles;
  std::vector<bool>       isAtLine;
  const std::vector<bool> isOnLine = FindLines(sheet);
  for (const MedialVoxelShellElement & element : sheet.elements)
  {
    const auto begin = element.corners.begin();
    for (unsigned int k = 2; k < element.numberOfCorners; ++k)
    {
      triangles.push_back({ { element.corners[0], element.corners[k - 1], element.corners[k] } });
      isAtLine.push_back(
        std::any_of(begin, begin + element.numberOfCorners, [&](const Index point) { return isOnLine[point]; }));
    }
  }
  m_Elements = std::make_unique<MedialVoxelSheetTree>(sheet.points, triangles, std::vector<Index>(triangles.size(), 0));
  for (const Index number : m_Elements->GetOrder())
  {
    const Triangle &            triangle = triangles[number];
    const std::array<Vector, 3> corners{
      { sheet.points[triangle[0]], sheet.points[triangle[1]], sheet.points[triangle[2]] }
    };
    const Vector middle = MedialVoxelMiddle(corners[0], corners[1]);
    const Vector center = MedialVoxelAddScaled(middle, MedialVoxelSubtract(corners[2], middle), 1.0 / 3.0);
    const double area = GetArea(corners) / 4.0;
    m_Samples.push_back({ center, area, isAtLine[number] });
    for (const Vector & corner : corners)
    {
      m_Samples.push_back({ MedialVoxelMiddle(corner, center), area, isAtLine[number] });
    }
  }
}

std::vector<double>
MedialVoxelSheetDistances::MeasurePoints(const MedialVoxelSheet & part) const
{
  std::vector<double>           result;
  MedialVoxelSheetTree::Nearest last;
  for (std::size_t k = 0; k < part.points.size() && !m_Samples.empty(); ++k)
  {
    // Points follow each other: the place of the last one is a bound.
    const double bound =
      k == 0 ? MedialVoxelSheetTree::Anywhere : MedialVoxelNorm(MedialVoxelSubtract(part.points[k], last.point));
    const auto nearest = m_Elements->Find(part.points[k], 0, bound);
    last = nearest.distance < bound ? nearest : last;
    result.push_back(std::min(nearest.distance, bound));
  }
  return result;
}

auto
MedialVoxelSheetDistances::FindBounds(const std::vector<Vector> & points) -> Bounds
{
  Bounds bounds{ points.front(), points.front() };
  for (const Vector & point : points)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      bounds.low[axis] = std::min(bounds.low[axis], point[axis]);
      bounds.high[axis] = std::max(bounds.high[axis], point[axis]);
    }
  }
  return bounds;
}

bool
MedialVoxelSheetDistances::AreWithin(const Bounds & a, const Bounds & b, const double distance)
{
  double sum = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double between = std::max({ a.low[axis] - b.high[axis], b.low[axis] - a.high[axis], 0.0 });
    sum += between * between;
  }
  return sum < distance * distance;
}

bool
MedialVoxelSheetDistances::BeginSamples(const double within)
{
  m_Within = within;
  m_Groups.clear();
  std::vector<Vector> points;
  const auto          endGroup = [&] {
    if (!points.empty())
    {
      m_Groups.back().bounds = FindBounds(points);
      points.clear();
    }
  };
  for (std::size_t k = 0; k < m_Samples.size(); ++k)
  {
    if (!std::isfinite(m_Samples[k].distance))
    {
      if (points.empty())
      {
        m_Groups.emplace_back();
      }
      m_Groups.back().samples.push_back(k);
      points.push_back(m_Samples[k].point);
    }
    if (points.size() == SamplesOfGroup)
    {
      endGroup();
    }
  }
  endGroup();
  return !m_Groups.empty();
}

std::vector<MedialVoxelSheetDistances::SampleDistance>
MedialVoxelSheetDistances::MeasureSamples(const MedialVoxelSheet & part) const
{
  std::vector<SampleDistance> result;
  if (part.triangles.empty())
  {
    return result;
  }
  std::optional<MedialVoxelSheetTree> tree; // where a sample is near
  const Bounds                        bounds = FindBounds(part.points);
  for (const Group & group : m_Groups)
  {
    const std::size_t number = AreWithin(group.bounds, bounds, m_Within) ? group.samples.size() : 0;
    for (std::size_t i = 0; i < number; ++i)
    {
      const Vector & point = m_Samples[group.samples[i]].point;
      if (AreWithin({ point, point }, bounds, m_Within))
      {
        if (!tree)
        {
          tree.emplace(part.points, part.triangles, std::vector<Index>(part.triangles.size(), 0));
        }
        const double distance = tree->Find(point, 0, m_Within).distance;
        if (distance < m_Within)
        {
          result.emplace_back(group.samples[i], distance);
        }
      }
    }
  }
  return result;
}

void
MedialVoxelSheetDistances::Add(const std::vector<double> & distancesOfPoints)
{
  for (const double distance : distancesOfPoints)
  {
    m_Points.Add(distance);
  }
}

void
MedialVoxelSheetDistances::Add(const std::vector<SampleDistance> & samples)
{
  for (const auto & [number, distance] : samples)
  {
    m_Samples[number].distance = std::min(m_Samples[number].distance, distance);
  }
}

void
MedialVoxelSheetDistances::Summarize(MedialVoxelRemeshingSummary & summary) const
{
  MedialVoxelDistanceHistogram histogram;
  std::array<double, 2>        sums{}; // elsewhere, and at lines
  std::array<double, 2>        areas{};
  for (const Sample & sample : m_Samples)
  {
    histogram.Add(sample.distance);
    sums[sample.isAtLine] += sample.area * sample.distance;
    areas[sample.isAtLine] += sample.area;
  }
  const auto divide = [](const double sum, const double by) { return by > 0.0 ? sum / by : 0.0; };
  summary.toFine = histogram.Summarize();
  summary.toFine.mean = divide(sums[0] + sums[1], areas[0] + areas[1]);
  summary.toFineElsewhere = divide(sums[0], areas[0]);
  summary.toFineAtLines = divide(sums[1], areas[1]);
  summary.shareElsewhere = divide(areas[0], areas[0] + areas[1]);
  summary.fromFine = m_Points.Summarize();
}

} // end namespace itk
