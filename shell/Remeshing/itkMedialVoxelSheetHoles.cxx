// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetHoles.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelSheetSides.h"
#include "itkMedialVoxelVector3.h"

#include <cmath>
#include <unordered_set>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Point = MedialVoxelVector3;
using Sides = std::vector<MedialVoxelSheetSide>;

constexpr Index None = ~Index{ 0 };

/** Of the circumference of a hole, over the thickness. */
constexpr double MostCircumference = 3.0;

/** A loop whose surface is not larger than this times the hole is the rim of a small piece. */
constexpr double LeastSurface = 2.0;

/** The neighbors of each point along rims; none where rims meet. */
std::vector<std::array<Index, 2>>
FindRims(const Sides & sides, const std::size_t numberOfPoints)
{
  std::vector<std::array<Index, 2>> rims(numberOfPoints, { { None, None } });
  std::vector<bool>                 isCorner(numberOfPoints);
  const auto                        add = [&](const Index point, const Index other) {
    std::array<Index, 2> & entry = rims[point];
    isCorner[point] = isCorner[point] || entry[1] != None;
    entry[entry[0] == None ? 0 : 1] = other;
  };
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && sides[first] == sides[last])
    {
      ++last;
    }
    if (last - first == 1)
    {
      add(sides[first].low, sides[first].high);
      add(sides[first].high, sides[first].low);
    }
    else if (last - first > 2)
    {
      isCorner[sides[first].low] = isCorner[sides[first].high] = true;
    }
  }
  for (std::size_t point = 0; point < numberOfPoints; ++point)
  {
    if (isCorner[point])
    {
      rims[point] = { { None, None } };
    }
  }
  return rims;
}

double
GetArea(const MedialVoxelSheet & sheet, const std::array<Index, 3> & corners)
{
  return MedialVoxelNorm(MedialVoxelTriangleNormal(
           { { sheet.points[corners[0]], sheet.points[corners[1]], sheet.points[corners[2]] } })) /
         2.0;
}

/** Whether the wall of a triangle has more than an area. */
bool
HasMoreThan(const MedialVoxelSheet & sheet, const Sides & sides, const Index triangle, const double area)
{
  std::vector<Index>        found(1, triangle);
  std::unordered_set<Index> isFound{ triangle };
  double                    sum = 0.0;
  for (std::size_t next = 0; next < found.size() && sum <= area; ++next)
  {
    const auto & corners = sheet.triangles[found[next]];
    sum += GetArea(sheet, corners);
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
      const auto range = std::equal_range(sides.begin(), sides.end(), MedialVoxelSheetSide{ low, high, 0 });
      for (auto side = range.first; side != range.second; ++side)
      {
        if (isFound.insert(side->triangle).second)
        {
          found.push_back(side->triangle);
        }
      }
    }
  }
  return sum > area;
}

/** \class HoleCloser
 * \brief Follows the rims from their lowest points. */
class HoleCloser
{
public:
  HoleCloser(MedialVoxelSheet & sheet, const double least)
    : m_Sheet(sheet)
    , m_Least(least)
    , m_Sides(MedialVoxelSortSides(sheet.triangles))
    , m_Rims(FindRims(m_Sides, sheet.points.size()))
  {}

  std::uint64_t
  Run()
  {
    std::uint64_t     holes = 0;
    std::vector<bool> isDone(m_Rims.size());
    for (Index start = 0; start < m_Rims.size(); ++start)
    {
      const std::vector<Index> loop =
        m_Rims[start][0] == None || isDone[start] ? std::vector<Index>{} : this->FollowShort(start);
      for (const Index point : loop)
      {
        isDone[point] = true;
      }
      holes += !loop.empty() && this->Close(loop) ? 1 : 0;
    }
    return holes;
  }

private:
  /** The loop of a point; empty when it meets others or is too long for a hole to be closed. */
  std::vector<Index>
  FollowShort(const Index start) const
  {
    std::vector<Index> loop;
    double             length = 0.0;
    double             size = this->GetSize(start);
    Index              before = None;
    for (Index point = start; loop.empty() || point != start;)
    {
      const Index next = m_Rims[point][0] != before ? m_Rims[point][0] : m_Rims[point][1];
      if (next == None)
      {
        return {};
      }
      loop.push_back(point);
      size = std::min(size, this->GetSize(next));
      length += MedialVoxelNorm(MedialVoxelSubtract(m_Sheet.points[next], m_Sheet.points[point]));
      if (length > MostCircumference * size)
      {
        return {};
      }
      before = point;
      point = next;
    }
    return loop;
  }

  double
  GetSize(const Index point) const
  {
    const double thickness = m_Sheet.thickness[point];
    return std::isfinite(thickness) ? std::max(m_Least, thickness) : m_Least;
  }

  /** With triangles to its middle. */
  bool
  Close(const std::vector<Index> & loop)
  {
    Point  middle{};
    double thickness = 0.0;
    for (const Index point : loop)
    {
      middle = MedialVoxelAddScaled(middle, m_Sheet.points[point], 1.0 / static_cast<double>(loop.size()));
      thickness += m_Sheet.thickness[point] / static_cast<double>(loop.size());
    }
    const auto center = static_cast<Index>(m_Sheet.points.size());
    m_Sheet.points.push_back(middle);
    m_Sheet.thickness.push_back(static_cast<float>(thickness));
    std::vector<std::array<Index, 3>> lid;
    double                            area = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      lid.push_back({ { loop[k], loop[(k + 1) % loop.size()], center } });
      area += GetArea(m_Sheet, lid.back());
    }
    const auto [low, high] = std::minmax(loop[0], loop[1]);
    const auto side = std::lower_bound(m_Sides.begin(), m_Sides.end(), MedialVoxelSheetSide{ low, high, 0 });
    if (!HasMoreThan(m_Sheet, m_Sides, side->triangle, LeastSurface * area))
    {
      m_Sheet.points.pop_back();
      m_Sheet.thickness.pop_back();
      return false;
    }
    m_Sheet.triangles.insert(m_Sheet.triangles.end(), lid.begin(), lid.end());
    return true;
  }

  MedialVoxelSheet &                m_Sheet;
  double                            m_Least;
  Sides                             m_Sides;
  std::vector<std::array<Index, 2>> m_Rims;
};

} // namespace

std::uint64_t
MedialVoxelCloseHoles(MedialVoxelSheet & sheet, const double least)
{
  return HoleCloser(sheet, least).Run();
}

} // end namespace itk
