// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestSurfaceOracle_h
#define MedialVoxelTestSurfaceOracle_h

// Vertices and faces of a medial surface from its crossed voxel edges, by brute force on the whole of it.

#include "MedialVoxelTestOracles.h"

#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace MedialVoxelTest
{
inline Index3
Moved(Index3 voxel, int axis, int by)
{
  voxel[axis] += by;
  return voxel;
}

/** \class SurfaceOracle
 * \brief Joins the faces of crossed voxel edges, which have four cells each, as the documents tell. */
class SurfaceOracle
{
public:
  /** Lower voxel and axis. */
  using Edge = std::pair<Index3, int>;

  /** What is asked about two voxels across from each other in the face between two cells. */
  struct Questions
  {
    /** Whether their boundary points are epsilon apart along the boundary, the largest one of the cells. */
    std::function<bool(const Index3 & v, const Index3 & w, const Index3 & cell, const Index3 & behind)> areApart;

    /** Squared distance of their boundary points. */
    std::function<double(const Index3 & v, const Index3 & w)> squaredDistance;
  };

  SurfaceOracle(const std::set<Edge> & crossed, const Questions & questions)
    : m_Crossed(crossed)
  {
    for (const Edge & edge : crossed)
    {
      for (const Index3 & cell : CellsAround(edge))
      {
        m_Corners[{ cell, edge }] = m_Parents.size();
        m_Parents.push_back(m_Parents.size());
      }
    }
    std::set<std::pair<Index3, int>> faces; // of cells: the cell below, and the normal
    for (const auto & corner : m_Corners)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        faces.insert({ corner.first.first, axis });
        faces.insert({ Moved(corner.first.first, axis, -1), axis });
      }
    }
    for (const auto & face : faces)
    {
      this->JoinAtFace(face.first, face.second, questions);
    }
  }

  /** Around an edge, from the highest on. */
  static std::array<Index3, 4>
  CellsAround(const Edge & edge)
  {
    const int    u = (edge.second + 1) % 3;
    const int    v = (edge.second + 2) % 3;
    const Index3 next = Moved(edge.first, u, -1);
    return { { edge.first, next, Moved(next, v, -1), Moved(edge.first, v, -1) } };
  }

  /** The edges of the faces at each vertex, by cells. */
  std::map<Index3, std::set<std::set<Edge>>>
  GetVertices() const
  {
    std::map<Index3, std::map<std::size_t, std::set<Edge>>> parts;
    for (const auto & corner : m_Corners)
    {
      parts[corner.first.first][this->RootOf(corner.second)].insert(corner.first.second);
    }
    std::map<Index3, std::set<std::set<Edge>>> vertices;
    for (const auto & cell : parts)
    {
      for (const auto & part : cell.second)
      {
        vertices[cell.first].insert(part.second);
      }
    }
    return vertices;
  }

  /** Faces that are taken off: fins and scraps. */
  std::set<Edge>
  GetTrimmed() const
  {
    std::map<std::pair<std::size_t, std::size_t>, int> sides;
    std::map<Index3, std::set<std::size_t>>            verticesOf;
    for (const Edge & edge : m_Crossed)
    {
      const auto corners = this->CornersOf(edge);
      for (int k = 0; k < 4; ++k)
      {
        ++sides[std::minmax(corners[k], corners[(k + 1) % 4])];
        verticesOf[CellsAround(edge)[k]].insert(corners[k]);
      }
    }
    std::set<Edge> trimmed;
    for (const Edge & edge : m_Crossed)
    {
      const auto corners = this->CornersOf(edge);
      int        rims = 0;
      int        junctions = 0;
      bool       touches = false;
      for (int k = 0; k < 4; ++k)
      {
        const int number = sides.at(std::minmax(corners[k], corners[(k + 1) % 4]));
        rims += number == 1 ? 1 : 0;
        junctions += number > 2 ? 1 : 0;
        touches = touches || verticesOf.at(CellsAround(edge)[k]).size() > 1;
      }
      if ((rims == 3 && junctions == 1) || (rims == 4 && touches))
      {
        trimmed.insert(edge);
      }
    }
    return trimmed;
  }

private:
  std::size_t
  RootOf(std::size_t corner) const
  {
    while (m_Parents[corner] != corner)
    {
      corner = m_Parents[corner];
    }
    return corner;
  }

  std::array<std::size_t, 4>
  CornersOf(const Edge & edge) const
  {
    std::array<std::size_t, 4> corners{};
    for (int k = 0; k < 4; ++k)
    {
      corners[k] = this->RootOf(m_Corners.at({ CellsAround(edge)[k], edge }));
    }
    return corners;
  }

  void
  JoinAtFace(const Index3 & cell, int normal, const Questions & questions)
  {
    const int    u = (normal + 1) % 3;
    const int    v = (normal + 2) % 3;
    const Index3 behind = Moved(cell, normal, 1);
    // The corners of the face in turn, and the edges between each and the next.
    const std::array<Index3, 4> voxels{
      { behind, Moved(behind, u, 1), Moved(Moved(behind, u, 1), v, 1), Moved(behind, v, 1) }
    };
    const std::array<Edge, 4> ring{ { { voxels[0], u }, { voxels[1], v }, { voxels[3], u }, { voxels[0], v } } };
    std::vector<int>          crossed;
    for (int k = 0; k < 4; ++k)
    {
      if (m_Crossed.count(ring[k]) > 0)
      {
        crossed.push_back(k);
      }
    }
    const auto join = [&](int a, int b) {
      for (const Index3 & side : { cell, behind })
      {
        m_Parents[this->RootOf(m_Corners.at({ side, ring[a] }))] = this->RootOf(m_Corners.at({ side, ring[b] }));
      }
    };
    const bool evenApart = crossed.size() < 4 || questions.areApart(voxels[0], voxels[2], cell, behind);
    const bool oddApart = crossed.size() < 4 || questions.areApart(voxels[1], voxels[3], cell, behind);
    if (evenApart && oddApart)
    {
      for (std::size_t k = 1; k < crossed.size(); ++k)
      {
        join(crossed[0], crossed[k]);
      }
      return;
    }
    const bool evenAreOne = !evenApart && (oddApart || questions.squaredDistance(voxels[0], voxels[2]) <=
                                                         questions.squaredDistance(voxels[1], voxels[3]));
    // Sheets go around the corners that are not of one side.
    const int around = evenAreOne ? 1 : 0;
    join(around, (around + 3) % 4);
    join(around + 1, around + 2);
  }

  std::set<Edge>                                 m_Crossed;
  std::map<std::pair<Index3, Edge>, std::size_t> m_Corners; // of faces, by cell
  std::vector<std::size_t>                       m_Parents; // of corners
};
} // namespace MedialVoxelTest

#endif // MedialVoxelTestSurfaceOracle_h
