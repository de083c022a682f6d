// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetTree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;

constexpr std::uint32_t TrianglesOfLeaf = 4;

/** No node, or no triangle. */
constexpr std::uint32_t Empty = ~std::uint32_t{ 0 };

Vector
Along(const Vector & from, const Vector & to, const double share)
{
  return {
    { from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), from[2] + share * (to[2] - from[2]) }
  };
}

Vector
NearestOfSegment(const Vector & point, const Vector & a, const Vector & b)
{
  const Vector side = MedialVoxelSubtract(b, a);
  const double length2 = MedialVoxelDot(side, side);
  const double share = length2 > 0.0 ? MedialVoxelDot(MedialVoxelSubtract(point, a), side) / length2 : 0.0;
  return Along(a, b, std::clamp(share, 0.0, 1.0));
}

double
GetDistance2(const Vector & a, const Vector & b)
{
  const Vector between = MedialVoxelSubtract(a, b);
  return MedialVoxelDot(between, between);
}

/** The larger of two numbers without a branch, which std::max() of three has. */
double
GetLarger(const double a, const double b)
{
  return a > b ? a : b;
}

template <typename TNode>
double
GetDistance2ToBox(const Vector & point, const TNode & node)
{
  double sum = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double outside = GetLarger(GetLarger(node.low[axis] - point[axis], point[axis] - node.high[axis]), 0.0);
    sum += outside * outside;
  }
  return sum;
}

} // namespace

Vector
MedialVoxelNearestOfTriangle(const Vector & point, const std::array<Vector, 3> & corners)
{
  const Vector ab = MedialVoxelSubtract(corners[1], corners[0]);
  const Vector ac = MedialVoxelSubtract(corners[2], corners[0]);
  const Vector normal = MedialVoxelCross(ab, ac);
  const double length2 = MedialVoxelDot(normal, normal);
  const Vector ap = MedialVoxelSubtract(point, corners[0]);
  const double v = MedialVoxelDot(MedialVoxelCross(ap, ac), normal);
  const double w = MedialVoxelDot(MedialVoxelCross(ab, ap), normal);
  if (length2 > 0.0 && v >= 0.0 && w >= 0.0 && v + w <= length2)
  {
    return { { corners[0][0] + (v / length2 * ab[0] + w / length2 * ac[0]),
               corners[0][1] + (v / length2 * ab[1] + w / length2 * ac[1]),
               corners[0][2] + (v / length2 * ab[2] + w / length2 * ac[2]) } };
  }
  // The nearest point is on a side that the point is beyond.
  const std::array<bool, 3> isBeyond{ { !(w >= 0.0), !(v + w <= length2), !(v >= 0.0) } };
  Vector                    best{};
  double                    distance2 = MedialVoxelSheetTree::Anywhere;
  for (unsigned int k = 0; k < 3; ++k)
  {
    if (isBeyond[k] || !(length2 > 0.0))
    {
      const Vector other = NearestOfSegment(point, corners[k], corners[(k + 1) % 3]);
      const double toOther = GetDistance2(point, other);
      best = toOther < distance2 ? other : best;
      distance2 = std::min(distance2, toOther);
    }
  }
  return best;
}

MedialVoxelSheetTree::MedialVoxelSheetTree(const std::vector<Point> &    points,
                                           const std::vector<Triangle> & triangles,
                                           const std::vector<Index> &    groups)
  : m_Points(&points)
  , m_Triangles(triangles)
  , m_Order(triangles.size())
{
  assert(groups.size() == triangles.size());
  std::vector<Index> ends;
  for (const Index group : groups)
  {
    ends.resize(std::max<std::size_t>(ends.size(), group + std::size_t{ 1 }));
    ++ends[group];
  }
  for (std::size_t group = 1; group < ends.size(); ++group)
  {
    ends[group] += ends[group - 1];
  }
  std::vector<Index> starts(ends.size());
  for (std::size_t group = 0; group < ends.size(); ++group)
  {
    starts[group] = group == 0 ? 0 : ends[group - 1];
  }
  std::vector<Index>                next = starts;
  std::vector<std::array<float, 3>> centers(triangles.size());
  for (Index number = 0; number < triangles.size(); ++number)
  {
    m_Order[next[groups[number]]++] = number;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const Triangle & corners = triangles[number];
      centers[number][axis] =
        static_cast<float>((points[corners[0]][axis] + points[corners[1]][axis] + points[corners[2]][axis]) / 3.0);
    }
  }
  for (std::size_t group = 0; group < ends.size(); ++group)
  {
    m_Roots.push_back(static_cast<Index>(m_Nodes.size()));
    if (ends[group] > starts[group])
    {
      this->Build(starts[group], ends[group] - starts[group], centers);
    }
    else
    {
      m_Roots.back() = Empty;
    }
  }
  for (std::size_t place = 0; place < m_Order.size(); ++place)
  {
    m_Triangles[place] = triangles[m_Order[place]];
  }
}

void
MedialVoxelSheetTree::Build(const Index first, const Index count, const std::vector<std::array<float, 3>> & centers)
{
  // m_Triangles is in the order given until all nodes are built.
  constexpr float   infinity = std::numeric_limits<float>::infinity();
  const std::size_t number = m_Nodes.size();
  m_Nodes.push_back({ { { infinity, infinity, infinity } }, { { -infinity, -infinity, -infinity } }, first, count });
  if (count <= TrianglesOfLeaf)
  {
    for (Index place = first; place < first + count; ++place)
    {
      for (const Index corner : m_Triangles[m_Order[place]])
      {
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const auto coordinate = static_cast<float>((*m_Points)[corner][axis]);
          m_Nodes[number].low[axis] = std::min(m_Nodes[number].low[axis], coordinate);
          m_Nodes[number].high[axis] = std::max(m_Nodes[number].high[axis], coordinate);
        }
      }
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Nodes[number].low[axis] = std::nextafter(m_Nodes[number].low[axis], -infinity);
      m_Nodes[number].high[axis] = std::nextafter(m_Nodes[number].high[axis], infinity);
    }
    return;
  }
  std::array<float, 3> low{ { infinity, infinity, infinity } };
  std::array<float, 3> high{ { -infinity, -infinity, -infinity } };
  for (Index place = first; place < first + count; ++place)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], centers[m_Order[place]][axis]);
      high[axis] = std::max(high[axis], centers[m_Order[place]][axis]);
    }
  }
  unsigned int widest = 0;
  for (unsigned int axis = 1; axis < 3; ++axis)
  {
    widest = high[axis] - low[axis] > high[widest] - low[widest] ? axis : widest;
  }
  const Index half = count / 2;
  const auto  begin = m_Order.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](const Index a, const Index b) {
    return centers[a][widest] != centers[b][widest] ? centers[a][widest] < centers[b][widest] : a < b;
  });
  this->Build(first, half, centers);
  const std::size_t right = m_Nodes.size();
  this->Build(first + half, count - half, centers);
  Node & node = m_Nodes[number];
  node.first = static_cast<Index>(right);
  node.count = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    node.low[axis] = std::min(m_Nodes[number + 1].low[axis], m_Nodes[right].low[axis]);
    node.high[axis] = std::max(m_Nodes[number + 1].high[axis], m_Nodes[right].high[axis]);
  }
}

MedialVoxelSheetTree::Nearest
MedialVoxelSheetTree::Find(const Point & point, const Index group, const double within) const
{
  Nearest best;
  if (group >= m_Roots.size() || m_Roots[group] == Empty)
  {
    return best;
  }
  best.distance = within * within;
  best.triangle = Empty;
  this->Search(m_Roots[group], point, 0.0, best);
  if (best.triangle == Empty)
  {
    return Nearest{};
  }
  best.distance = std::sqrt(best.distance);
  best.triangle = m_Order[best.triangle];
  return best;
}

bool
MedialVoxelSheetTree::HasWithin(const Point & point, const Index group, const double within) const
{
  Nearest best;
  best.distance = within * within;
  best.triangle = Empty;
  if (group < m_Roots.size() && m_Roots[group] != Empty)
  {
    this->Search(m_Roots[group], point, best.distance, best);
  }
  return best.triangle != Empty;
}

/** \a best has the square of the distance and the place in the tree. */
void
MedialVoxelSheetTree::Search(const Index number, const Point & point, const double enough, Nearest & best) const
{
  const Node & node = m_Nodes[number];
  if (node.count == 0)
  {
    const Index  left = number + 1;
    const double toLeft = GetDistance2ToBox(point, m_Nodes[left]);
    const double toRight = GetDistance2ToBox(point, m_Nodes[node.first]);
    const bool   leftFirst = toLeft <= toRight;
    if (std::min(toLeft, toRight) < best.distance)
    {
      this->Search(leftFirst ? left : node.first, point, enough, best);
    }
    if (std::max(toLeft, toRight) < best.distance && !(best.distance < enough))
    {
      this->Search(leftFirst ? node.first : left, point, enough, best);
    }
    return;
  }
  for (Index place = node.first; place < node.first + node.count; ++place)
  {
    const Triangle & corners = m_Triangles[place];
    const Vector     nearest = MedialVoxelNearestOfTriangle(
      point, { { (*m_Points)[corners[0]], (*m_Points)[corners[1]], (*m_Points)[corners[2]] } });
    const double distance2 = GetDistance2(point, nearest);
    if (distance2 < best.distance)
    {
      best = { nearest, distance2, place };
      if (distance2 < enough)
      {
        return;
      }
    }
  }
}

} // end namespace itk
