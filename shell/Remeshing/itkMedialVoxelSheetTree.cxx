// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetTree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

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

constexpr float Infinity = std::numeric_limits<float>::infinity();

/** Boxes are not searched beyond it: nodes with fewer children have some at an infinite distance. */
constexpr double MostDistance2 = std::numeric_limits<float>::max() / 2.0;

/** More than rounding to single precision changes a coordinate. */
float
GetMargin(const float coordinate)
{
  return 2.5e-7F * std::abs(coordinate);
}

/** Rounding may make the distance of a box larger by this factor. */
constexpr double RoundingOfDistance = 1.000002;

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

/** \class MedialVoxelSheetTree::Builder
 * \brief Puts triangles in an order in which neighbors follow each other, and makes nodes of them. */
class MedialVoxelSheetTree::Builder
{
public:
  Builder(MedialVoxelSheetTree & tree, const std::vector<Index> & groups)
    : m_Tree(tree)
    , m_Items(groups.size())
  {
    std::vector<Index> ends;
    for (const Index group : groups)
    {
      ends.resize(std::max<std::size_t>(ends.size(), group + std::size_t{ 1 }));
      ++ends[group];
    }
    std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), Index{ 0 });
    for (Index number = 0; number < groups.size(); ++number)
    {
      m_Items[ends[groups[number]]++] = { GetCenter(number), number };
    }
    Index first = 0;
    for (const Index end : ends)
    {
      m_Tree.m_Roots.push_back(first == end ? Empty : this->AddNode({ first, end }));
      first = end;
    }
    for (const Item & item : m_Items)
    {
      m_Tree.m_Order.push_back(item.number);
    }
  }

private:
  struct Item
  {
    std::array<float, 3> center;
    Index                number;
  };

  struct Range
  {
    Index first;
    Index end;

    bool
    IsLeaf() const
    {
      return end - first <= TrianglesOfLeaf;
    }
  };

  struct Box
  {
    std::array<float, 3> low{ { Infinity, Infinity, Infinity } };
    std::array<float, 3> high{ { -Infinity, -Infinity, -Infinity } };

    void
    Add(const unsigned int axis, const float coordinate)
    {
      low[axis] = std::min(low[axis], coordinate);
      high[axis] = std::max(high[axis], coordinate);
    }
  };

  std::array<float, 3>
  GetCenter(const Index number) const
  {
    const Triangle &     corners = m_Tree.m_Triangles[number];
    std::array<float, 3> center{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto at = [&](const unsigned int k) { return (*m_Tree.m_Points)[corners[k]][axis]; };
      center[axis] = static_cast<float>((at(0) + at(1) + at(2)) / 3.0);
    }
    return center;
  }

  /** Divides a range in two across its longest direction. */
  std::array<Range, 2>
  Divide(const Range & range)
  {
    Box box;
    for (Index place = range.first; place < range.end; ++place)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        box.Add(axis, m_Items[place].center[axis]);
      }
    }
    unsigned int widest = 0;
    for (unsigned int axis = 1; axis < 3; ++axis)
    {
      widest = box.high[axis] - box.low[axis] > box.high[widest] - box.low[widest] ? axis : widest;
    }
    const Index half = range.first + (range.end - range.first) / 2;
    const auto  begin = m_Items.begin();
    std::nth_element(begin + range.first, begin + half, begin + range.end, [widest](const Item & a, const Item & b) {
      return a.center[widest] != b.center[widest] ? a.center[widest] < b.center[widest] : a.number < b.number;
    });
    return { { { range.first, half }, { half, range.end } } };
  }

  /** \return its number */
  Index
  AddNode(const Range & range)
  {
    const auto number = static_cast<Index>(m_Tree.m_Nodes.size());
    m_Tree.m_Nodes.emplace_back();
    m_Tree.m_Nodes.back().low.fill(Lanes{} + Infinity);
    m_Tree.m_Nodes.back().high.fill(Lanes{} - Infinity);
    std::size_t child = 0;
    if (range.IsLeaf())
    {
      this->AddChild(number, child, range);
      return number;
    }
    for (const Range & half : this->Divide(range))
    {
      if (half.IsLeaf())
      {
        this->AddChild(number, child++, half);
        continue;
      }
      for (const Range & quarter : this->Divide(half))
      {
        this->AddChild(number, child++, quarter);
      }
    }
    return number;
  }

  void
  AddChild(const Index number, const std::size_t child, const Range & range)
  {
    // Nodes move while others are added.
    const Index first = range.IsLeaf() ? range.first : this->AddNode(range);
    const Box   box = range.IsLeaf() ? this->GetBox(range) : GetBox(m_Tree.m_Nodes[first]);
    Node &      node = m_Tree.m_Nodes[number];
    node.first[child] = first;
    node.count[child] = range.IsLeaf() ? range.end - range.first : 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      node.low[axis][child] = box.low[axis];
      node.high[axis][child] = box.high[axis];
    }
  }

  Box
  GetBox(const Range & leaf) const
  {
    Box box;
    for (Index place = leaf.first; place < leaf.end; ++place)
    {
      for (const Index corner : m_Tree.m_Triangles[m_Items[place].number])
      {
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const auto coordinate = static_cast<float>((*m_Tree.m_Points)[corner][axis]);
          box.Add(axis, coordinate - GetMargin(coordinate));
          box.Add(axis, coordinate + GetMargin(coordinate));
        }
      }
    }
    return box;
  }

  static Box
  GetBox(const Node & node)
  {
    Box box;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (std::size_t child = 0; child < ChildrenOfNode; ++child)
      {
        box.low[axis] = std::min(box.low[axis], node.low[axis][child]);
        box.high[axis] = std::max(box.high[axis], node.high[axis][child]);
      }
    }
    return box;
  }

  MedialVoxelSheetTree & m_Tree;
  std::vector<Item>      m_Items;
};

MedialVoxelSheetTree::Query::Query(const Point & place, const double enoughDistance2)
  : point(place)
  , enough(enoughDistance2)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto coordinate = static_cast<float>(point[axis]);
    below[axis] = Lanes{} + (coordinate - GetMargin(coordinate));
    above[axis] = Lanes{} + (coordinate + GetMargin(coordinate));
  }
}

MedialVoxelSheetTree::MedialVoxelSheetTree(const std::vector<Point> &    points,
                                           const std::vector<Triangle> & triangles,
                                           const std::vector<Index> &    groups)
  : m_Points(&points)
  , m_Triangles(triangles)
{
  assert(groups.size() == triangles.size());
  Builder(*this, groups);
  for (std::size_t place = 0; place < m_Order.size(); ++place)
  {
    m_Triangles[place] = triangles[m_Order[place]];
  }
}

auto
MedialVoxelSheetTree::Find(const Point & point, const Index group, const double within) const -> Nearest
{
  Nearest best{ {}, within * within, Empty };
  if (group < m_Roots.size() && m_Roots[group] != Empty)
  {
    this->Search(m_Roots[group], { point, 0.0 }, best);
  }
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
  Nearest best{ {}, within * within, Empty };
  if (group < m_Roots.size() && m_Roots[group] != Empty)
  {
    this->Search(m_Roots[group], { point, best.distance }, best);
  }
  return best.triangle != Empty;
}

void
MedialVoxelSheetTree::Search(const Index number, const Query & query, Nearest & best) const
{
  const Node & node = m_Nodes[number];
  Lanes        distances2{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const Lanes before = node.low[axis] - query.above[axis];
    const Lanes behind = query.below[axis] - node.high[axis];
    const Lanes farther = MedialVoxelSelect(before > behind, before, behind);
    const Lanes outside = MedialVoxelSelect(farther > Lanes{}, farther, Lanes{});
    distances2 += outside * outside;
  }
  for (std::size_t visits = 0; visits < ChildrenOfNode; ++visits)
  {
    std::size_t child = 0;
    for (std::size_t k = 1; k < ChildrenOfNode; ++k)
    {
      child = distances2[k] < distances2[child] ? k : child;
    }
    if (distances2[child] > RoundingOfDistance * std::min(best.distance, MostDistance2) || best.distance < query.enough)
    {
      return;
    }
    distances2[child] = Infinity;
    if (node.count[child] == 0)
    {
      this->Search(node.first[child], query, best);
    }
    else
    {
      this->SearchLeaf(node.first[child], node.count[child], query, best);
    }
  }
}

void
MedialVoxelSheetTree::SearchLeaf(const Index first, const Index count, const Query & query, Nearest & best) const
{
  for (Index place = first; place < first + count && !(best.distance < query.enough); ++place)
  {
    const Triangle & corners = m_Triangles[place];
    const Vector     nearest = MedialVoxelNearestOfTriangle(
      query.point, { { (*m_Points)[corners[0]], (*m_Points)[corners[1]], (*m_Points)[corners[2]] } });
    const double distance2 = GetDistance2(query.point, nearest);
    if (distance2 < best.distance ||
        (distance2 == best.distance && best.triangle != Empty && m_Order[place] < m_Order[best.triangle]))
    {
      best = { nearest, distance2, place };
    }
  }
}

} // end namespace itk
