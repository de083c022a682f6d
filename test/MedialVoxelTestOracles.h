// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestOracles_h
#define MedialVoxelTestOracles_h

// Brute force forms of the definitions: slow, obvious, and sharing no line with
// the library.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace MedialVoxelTest
{
using Index3 = std::array<int, 3>;
using Vector3 = std::array<double, 3>;

constexpr Vector3 UnitSpacing{ { 1.0, 1.0, 1.0 } };

/** A binary volume, x fastest; two dimensions are size[2] == 1. */
struct Volume
{
  Index3                     size{ { 1, 1, 1 } };
  Vector3                    spacing{ { 1.0, 1.0, 1.0 } };
  std::vector<unsigned char> object;

  Volume() = default;
  Volume(const Index3 & s, const Vector3 & sp)
    : size(s)
    , spacing(sp)
    , object(static_cast<std::size_t>(s[0]) * s[1] * s[2], 0)
  {}

  bool
  Contains(const Index3 & v) const
  {
    return v[0] >= 0 && v[1] >= 0 && v[2] >= 0 && v[0] < size[0] && v[1] < size[1] && v[2] < size[2];
  }
  std::size_t
  Offset(const Index3 & v) const
  {
    return (static_cast<std::size_t>(v[2]) * size[1] + v[1]) * size[0] + v[0];
  }
  Index3
  IndexAt(std::size_t offset) const
  {
    const auto x = static_cast<int>(offset % size[0]);
    const auto y = static_cast<int>(offset / size[0] % size[1]);
    const auto z = static_cast<int>(offset / size[0] / size[1]);
    return { { x, y, z } };
  }
  bool
  IsObject(const Index3 & v) const
  {
    return object[this->Offset(v)] != 0;
  }
  void
  Set(const Index3 & v, bool isObject)
  {
    object[this->Offset(v)] = isObject ? 1 : 0;
  }
  /** The axes longer than one voxel, in order. */
  std::vector<int>
  Axes() const
  {
    std::vector<int> axes;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (size[axis] > 1)
      {
        axes.push_back(axis);
      }
    }
    return axes;
  }
  /** Whether the axes longer than one voxel have one spacing. */
  bool
  HasEqualSpacing() const
  {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (size[axis] > 1)
      {
        smallest = std::min(smallest, spacing[axis]);
        largest = std::max(largest, spacing[axis]);
      }
    }
    return smallest >= largest;
  }
};

enum class BoundarySide
{
  Background,
  Object
};

/** Definition 2: voxels of one side with a voxel of the other side among their
 * 3^D - 1 neighbors. */
inline std::vector<Index3>
BoundarySites(const Volume & volume, BoundarySide side = BoundarySide::Background)
{
  std::vector<Index3> sites;
  const bool          siteIsObject = side == BoundarySide::Object;
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    const Index3 v = volume.IndexAt(i);
    bool         touches = false;
    for (int dz = -1; dz <= 1; ++dz)
    {
      for (int dy = -1; dy <= 1; ++dy)
      {
        for (int dx = -1; dx <= 1; ++dx)
        {
          const Index3 n{ { v[0] + dx, v[1] + dy, v[2] + dz } };
          touches = touches || (volume.Contains(n) && volume.IsObject(n) != siteIsObject);
        }
      }
    }
    if (touches && volume.IsObject(v) == siteIsObject)
    {
      sites.push_back(v);
    }
  }
  return sites;
}

/** D2 of definition 3; index units where the spacings of the axes longer than
 * one voxel are equal. */
inline double
KeyDistance(const Volume & volume, const Index3 & v, const Index3 & b)
{
  const std::int64_t dx = b[0] - v[0];
  const std::int64_t dy = b[1] - v[1];
  const std::int64_t dz = b[2] - v[2];
  if (volume.HasEqualSpacing())
  {
    return static_cast<double>(dx * dx + dy * dy + dz * dz);
  }
  const double x = static_cast<double>(dx) * volume.spacing[0];
  const double y = static_cast<double>(dy) * volume.spacing[1];
  const double z = static_cast<double>(dz) * volume.spacing[2];
  return ((x * x) + (y * y)) + (z * z);
}

/** Physical length of b - v. */
inline double
PhysicalDistance(const Volume & volume, const Index3 & v, const Index3 & b)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double d = (b[axis] - v[axis]) * volume.spacing[axis];
    sum += d * d;
  }
  return std::sqrt(sum);
}

/** Definition 3: position in `sites` of the site with the smallest key (D2, z,
 * y, x); -1 without sites. */
inline long
NearestSite(const Volume & volume, const std::vector<Index3> & sites, const Index3 & v)
{
  using Key = std::tuple<double, int, int, int>;
  Key  best{ std::numeric_limits<double>::infinity(), 0, 0, 0 };
  long nearest = -1;
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    const Index3 & b = sites[i];
    const Key      key{ KeyDistance(volume, v, b), b[2], b[1], b[0] };
    if (key < best)
    {
      best = key;
      nearest = static_cast<long>(i);
    }
  }
  return nearest;
}

/** How many sites share the smallest D2 of v, where distances closer than the
 * relative `gap` count as equal. */
inline int
CountNearestSites(const Volume & volume, const std::vector<Index3> & sites, const Index3 & v, double gap = 1e-12)
{
  double best = std::numeric_limits<double>::infinity();
  for (const Index3 & b : sites)
  {
    best = std::min(best, KeyDistance(volume, v, b));
  }
  return static_cast<int>(std::count_if(
    sites.begin(), sites.end(), [&](const Index3 & b) { return KeyDistance(volume, v, b) <= best * (1.0 + gap); }));
}

/** Definition 3 at every voxel for which `wanted` is not 0. */
inline std::vector<long>
NearestSites(const Volume & volume, const std::vector<Index3> & sites, const std::vector<unsigned char> & wanted)
{
  std::vector<long> nearest(volume.object.size(), -1);
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    nearest[i] = wanted[i] ? NearestSite(volume, sites, volume.IndexAt(i)) : -1;
  }
  return nearest;
}

/** N of every object voxel and of every site itself; -1 elsewhere. */
inline std::vector<long>
NearestBoundaryPoints(const Volume & volume, const std::vector<Index3> & sites)
{
  std::vector<unsigned char> wanted = volume.object;
  for (const Index3 & b : sites)
  {
    wanted[volume.Offset(b)] = 1;
  }
  return NearestSites(volume, sites, wanted);
}

/** Length of a move along all axes of `mask` (bit 0 = x, 1 = y, 2 = z). */
inline double
EdgeLength(const Volume & volume, int mask)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    sum += (mask >> axis & 1) ? volume.spacing[axis] * volume.spacing[axis] : 0.0;
  }
  return std::sqrt(sum);
}

/** Number of moves of each edge class; entry 0 is not used. */
using EdgeCounts = std::array<int, 8>;

/** Definition 7: the sum of count * edge length in mask order. */
inline double
PathLength(const Volume & volume, const EdgeCounts & counts)
{
  double length = 0.0;
  for (int mask = 1; mask < 8; ++mask)
  {
    if (counts[mask] != 0)
    {
      length += counts[mask] * EdgeLength(volume, mask);
    }
  }
  return length;
}

/** Definition 8: shortest path in the complete grid graph, by trying every mix
 * of moves that never turns back. */
inline double
FreeSpaceLength(const Volume & volume, const Index3 & a, const Index3 & b)
{
  const int x = std::abs(a[0] - b[0]);
  const int y = std::abs(a[1] - b[1]);
  const int z = std::abs(a[2] - b[2]);
  double    best = std::numeric_limits<double>::infinity();
  for (int xyz = 0; xyz <= std::min({ x, y, z }); ++xyz)
  {
    for (int xy = 0; xy <= std::min(x, y) - xyz; ++xy)
    {
      for (int xz = 0; xz <= std::min(x - xy, z) - xyz; ++xz)
      {
        for (int yz = 0; yz <= std::min(y - xy, z - xz) - xyz; ++yz)
        {
          const EdgeCounts counts{ { 0, x - xyz - xy - xz, y - xyz - xy - yz, xy, z - xyz - xz - yz, xz, yz, xyz } };
          best = std::min(best, PathLength(volume, counts));
        }
      }
    }
  }
  return best;
}

/** The graph on the boundary points with 3^D - 1 adjacency and physical edge
 * lengths. */
class BoundaryGraph
{
public:
  BoundaryGraph(const Volume & volume, const std::vector<Index3> & sites)
    : m_Volume(volume)
    , m_Edges(sites.size())
  {
    std::map<Index3, int> nodeAt;
    for (std::size_t i = 0; i < sites.size(); ++i)
    {
      nodeAt[sites[i]] = static_cast<int>(i);
    }
    for (std::size_t i = 0; i < sites.size(); ++i)
    {
      for (int move = 0; move < 27; ++move)
      {
        const Index3 step{ { move % 3 - 1, move / 3 % 3 - 1, move / 9 - 1 } };
        const int    mask = (step[0] != 0) + 2 * (step[1] != 0) + 4 * (step[2] != 0);
        const auto   found = nodeAt.find({ { sites[i][0] + step[0], sites[i][1] + step[1], sites[i][2] + step[2] } });
        if (mask != 0 && found != nodeAt.end())
        {
          m_Edges[i].emplace_back(found->second, mask);
        }
      }
    }
  }

  /** Plain Dijkstra over the whole graph; `limit` only stops the search once
   * every shorter node is settled. */
  std::vector<double>
  DistancesFrom(int source, double limit = std::numeric_limits<double>::infinity()) const
  {
    using Entry = std::pair<double, int>;
    std::vector<double> distance(m_Edges.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    distance[source] = 0.0;
    queue.push({ 0.0, source });
    while (!queue.empty() && queue.top().first <= limit)
    {
      const Entry top = queue.top();
      queue.pop();
      for (const auto & edge : m_Edges[top.second])
      {
        const double length = top.first + EdgeLength(m_Volume, edge.second);
        if (top.first == distance[top.second] && length < distance[edge.first])
        {
          distance[edge.first] = length;
          queue.push({ length, edge.first });
        }
      }
    }
    return distance;
  }

  /** Definition 7 to the letter, for small graphs: every walk no longer than
   * `limit`, by its edge counts. */
  std::vector<double>
  ExactDistancesFrom(int source, double limit) const
  {
    using State = std::pair<int, EdgeCounts>;
    std::vector<double> distance(m_Edges.size(), std::numeric_limits<double>::infinity());
    std::set<State>     seen;
    std::queue<State>   queue;
    seen.insert({ source, EdgeCounts{} });
    queue.push({ source, EdgeCounts{} });
    while (!queue.empty())
    {
      const State state = queue.front();
      queue.pop();
      distance[state.first] = std::min(distance[state.first], PathLength(m_Volume, state.second));
      for (const auto & edge : m_Edges[state.first])
      {
        State next{ edge.first, state.second };
        ++next.second[edge.second];
        if (PathLength(m_Volume, next.second) <= limit && seen.insert(next).second)
        {
          queue.push(next);
        }
      }
    }
    return distance;
  }

private:
  const Volume &                                m_Volume;
  std::vector<std::vector<std::pair<int, int>>> m_Edges;
};
} // namespace MedialVoxelTest

#endif // MedialVoxelTestOracles_h
