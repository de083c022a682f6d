// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestManifold_h
#define MedialVoxelTestManifold_h

// Whether a surface is a manifold, from the vertices of its faces alone.

#include "MedialVoxelTestSurface.h"

#include <set>

namespace MedialVoxelTest
{
/** What keeps a surface from being a manifold with rims. */
struct ManifoldFaults
{
  std::vector<Vector3> edges;              ///< middles of those with more than two faces
  std::vector<Vector3> fans;               ///< vertices whose faces are not one fan, none of whose edges is among these
  std::size_t          fins{ 0 };          ///< faces that hang at others by one side, with more than one on it
  std::size_t          repeatedFaces{ 0 }; ///< with the vertices of another one
  std::size_t          brokenFaces{ 0 };   ///< that name a vertex twice

  bool
  IsManifold() const
  {
    return edges.empty() && fans.empty() && repeatedFaces == 0 && brokenFaces == 0;
  }
};

inline Vector3
Middle(const Vector3 & a, const Vector3 & b)
{
  return { { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2 } };
}

/** Whether the edges opposite to a vertex, of faces with at most two at each edge, are one path or one ring. */
inline bool
IsOneFan(const std::vector<std::pair<std::uint64_t, std::uint64_t>> & links)
{
  std::map<std::uint64_t, std::vector<std::uint64_t>> next;
  for (const auto & link : links)
  {
    next[link.first].push_back(link.second);
    next[link.second].push_back(link.first);
  }
  std::set<std::uint64_t>    reached{ next.begin()->first };
  std::vector<std::uint64_t> open{ next.begin()->first };
  while (!open.empty())
  {
    const std::uint64_t from = open.back();
    open.pop_back();
    for (const std::uint64_t to : next[from])
    {
      if (reached.insert(to).second)
      {
        open.push_back(to);
      }
    }
  }
  return reached.size() == next.size();
}

inline ManifoldFaults
FindManifoldFaults(const Surface & surface)
{
  ManifoldFaults faults;
  const auto     sides = CountSides(surface);
  const auto     facesAt = [&](std::uint64_t a, std::uint64_t b) { return sides.at(std::minmax(a, b)); };

  std::vector<bool> isAtFault(surface.vertices.size(), false);
  for (const auto & side : sides)
  {
    if (side.second > 2)
    {
      const auto & [a, b] = side.first;
      faults.edges.push_back(Middle(surface.vertices[a].point, surface.vertices[b].point));
      isAtFault[a] = isAtFault[b] = true;
    }
  }
  // The neighbors of a vertex in a face are joined by that face: a fan is a path of them, or a ring.
  std::vector<std::vector<std::pair<std::uint64_t, std::uint64_t>>> links(surface.vertices.size());
  std::set<std::set<std::uint64_t>>                                 seen;
  for (const auto & quad : surface.quads)
  {
    const auto &                  v = quad.vertices;
    const std::set<std::uint64_t> corners(v.begin(), v.end());
    faults.brokenFaces += corners.size() < 4 ? 1 : 0;
    faults.repeatedFaces += seen.insert(corners).second ? 0 : 1;
    int rims = 0;
    int joints = 0;
    for (int k = 0; k < 4; ++k)
    {
      links[v[k]].emplace_back(v[(k + 3) % 4], v[(k + 1) % 4]);
      rims += facesAt(v[k], v[(k + 1) % 4]) == 1 ? 1 : 0;
      joints += facesAt(v[k], v[(k + 1) % 4]) > 2 ? 1 : 0;
    }
    faults.fins += rims == 3 && joints == 1 ? 1 : 0;
  }
  for (std::size_t vertex = 0; vertex < links.size(); ++vertex)
  {
    if (links[vertex].empty() || (!isAtFault[vertex] && !IsOneFan(links[vertex])))
    {
      faults.fans.push_back(surface.vertices[vertex].point);
    }
  }
  return faults;
}

/** Vertices less edges and plus faces. */
inline long
EulerNumber(const Surface & surface)
{
  return static_cast<long>(surface.vertices.size() + surface.quads.size()) -
         static_cast<long>(CountSides(surface).size());
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestManifold_h
