// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTriangleComplex_h
#define itkMedialVoxelTriangleComplex_h

#include "itkMedialVoxelShortList.h"
#include "itkMedialVoxelVector3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelTriangleComplex
 * \brief Triangles of which any number may share a side, and the steps that change them.
 *
 * No two triangles have the same vertices. Triangles keep their numbers until they are removed; the number of a
 * triangle that was removed is given to one that is added. What is done depends on the order of the calls alone.
 * \ingroup MedialVoxel
 */
class MedialVoxelTriangleComplex
{
public:
  using Index = std::uint32_t;
  using Triangle = std::array<Index, 3>;
  using Point = MedialVoxelVector3;

  /** Memory of the complex at most, for each triangle of a surface: half a vertex, with its list. */
  static constexpr std::uint64_t BytesPerTriangle = 96;

  static constexpr Index None = ~Index{ 0 };

  struct Vertex
  {
    Point point{};
    float size{ 0 };         ///< that sides at the vertex are to have
    bool  isShared{ false }; ///< other triangles have it, too, that are not here: it stays where it is
  };

  /** A vertex at the other end of a side, and how many triangles the side has. */
  struct Neighbor
  {
    Index        vertex;
    unsigned int triangles;
  };
  using Neighbors = MedialVoxelShortList<Neighbor, 16>;
  using Indices = MedialVoxelShortList<Index, 16>;

  /** Where a vertex lies: inside a wall, on a line of one kind, or where lines begin, end or meet. */
  enum class Place : std::uint8_t
  {
    Wall,
    Rim,
    Junction,
    Corner
  };

  Index
  AddVertex(const Point & point);

  /** \pre the vertices differ and exist, and there is no such triangle. \a wall is kept for it. */
  Index
  AddTriangle(const Triangle & triangle, Index wall);

  /** Triangles with their numbers, also removed ones. */
  Index
  GetNumberOfTriangles() const
  {
    return static_cast<Index>(m_Triangles.size());
  }
  Index
  GetNumberOfVertices() const
  {
    return static_cast<Index>(m_Vertices.size());
  }
  bool
  IsTriangle(Index triangle) const
  {
    return m_Triangles[triangle][0] != None;
  }
  const Triangle &
  GetTriangle(Index triangle) const
  {
    return m_Triangles[triangle];
  }
  Index
  GetWall(Index triangle) const
  {
    return m_Walls[triangle];
  }
  /** How many of the walls from 0 on have no triangle. */
  std::vector<bool>
  FindWallsKept(Index numberOfWalls) const;

  Vertex &
  GetVertex(Index vertex)
  {
    return m_Vertices[vertex];
  }
  const Point &
  GetPoint(Index vertex) const
  {
    return m_Vertices[vertex].point;
  }
  float
  GetSize(Index vertex) const
  {
    return m_Vertices[vertex].size;
  }
  std::array<Point, 3>
  GetCorners(Index triangle) const;

  /** Numbers of the triangles of a vertex; none of a vertex that has been removed. */
  const std::vector<Index> &
  GetTrianglesOf(Index vertex) const
  {
    return m_TrianglesOf[vertex];
  }

  bool
  IsShared(Index vertex) const
  {
    return m_Vertices[vertex].isShared;
  }

  /** The triangles of the side from a to b. */
  Indices
  FindTriangles(Index a, Index b) const;

  unsigned int
  CountTriangles(Index a, Index b) const;

  bool
  HasTriangle(const Triangle & triangle) const;

  /** The corner of a triangle that is neither a nor b. */
  Index
  GetOpposite(Index triangle, Index a, Index b) const;

  /** Vertices that share a side with a vertex, in the order of their numbers, from \a least on. */
  Neighbors
  FindNeighbors(Index vertex, Index least = 0) const;

  /** A shared vertex is a corner. */
  Place
  GetPlace(Index vertex) const;

  /** Whether a vertex has a side that belongs to one triangle only. */
  bool
  IsOnRim(Index vertex) const;

  /** Whether the complex keeps its topology when the vertices of a side become one: whether both have no common
   * neighbors but the corners opposite to the side, and not both lie on rims, unless the side does or \a pinching. No
   * when \a is shared, or gives \a b a side to another shared vertex. */
  bool
  CanCollapse(Index a, Index b, bool pinching = false) const
  {
    return this->CanCollapse(a, this->FindNeighbors(a), b, pinching);
  }

  /** The same, with the neighbors of a that were found. */
  bool
  CanCollapse(Index a, const Neighbors & ofA, Index b, bool pinching = false) const;

  /** Puts a vertex on a neighbor of it; triangles of their side are removed. \pre CanCollapse(from, to) */
  void
  Collapse(Index from, Index to);

  /** Makes two vertices one, which is where \a to is. \pre no triangle has both, and none is twice then */
  void
  Merge(Index from, Index to);

  /** Cuts a side and its triangles at a point; each triangle keeps the half of a.
   * \param halves  the new triangles, in the order of FindTriangles(a, b)
   * \return the new vertex */
  Index
  Split(Index a, Index b, const Point & point, std::vector<Index> & halves);

  void
  RemoveTriangle(Index triangle);

private:
  void
  Detach(Index triangle, Index vertex);

  std::vector<Vertex>             m_Vertices;
  std::vector<std::vector<Index>> m_TrianglesOf;
  std::vector<Triangle>           m_Triangles;
  std::vector<Index>              m_Walls;
  std::vector<Index>              m_Free; ///< places of removed triangles
};

} // end namespace itk

#endif
