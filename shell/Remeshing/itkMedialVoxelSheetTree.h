// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetTree_h
#define itkMedialVoxelSheetTree_h

#include "itkMedialVoxelLanes.h"
#include "itkMedialVoxelVector3.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** The point of a triangle that is nearest to another one. */
MedialVoxelVector3
MedialVoxelNearestOfTriangle(const MedialVoxelVector3 & point, const std::array<MedialVoxelVector3, 3> & corners);

/** \class MedialVoxelSheetTree
 * \brief Finds the nearest of many triangles, or segments, in groups that are searched one at a time.
 *
 * A tree of boxes, four to a node. A segment is a triangle whose last two corners are one. Of several nearest ones it
 * takes the one that was given first.
 * \ingroup MedialVoxel
 */
class MedialVoxelSheetTree
{
public:
  using Index = std::uint32_t;
  using Triangle = std::array<Index, 3>;
  using Point = MedialVoxelVector3;

  /** Memory for each triangle. */
  static constexpr std::uint64_t BytesPerTriangle = 64;

  static constexpr double Anywhere = std::numeric_limits<double>::infinity();

  struct Nearest
  {
    Point  point{};
    double distance{ Anywhere }; ///< infinite: none is near enough
    Index  triangle{ 0 };        ///< its place in the order they were given in
  };

  /** \param points  stays as long as the tree is used
   * \param groups  of each triangle, from 0 on without gaps */
  MedialVoxelSheetTree(const std::vector<Point> &    points,
                       const std::vector<Triangle> & triangles,
                       const std::vector<Index> &    groups);

  Index
  GetNumberOfGroups() const
  {
    return static_cast<Index>(m_Roots.size());
  }

  /** Numbers of the triangles, so that neighbors mostly follow each other. */
  const std::vector<Index> &
  GetOrder() const
  {
    return m_Order;
  }

  /** The nearest of a group that is nearer than \a within. */
  Nearest
  Find(const Point & point, Index group, double within = Anywhere) const;

  /** Whether one of a group is nearer than \a within; faster than to find the nearest. */
  bool
  HasWithin(const Point & point, Index group, double within) const;

private:
  static constexpr std::size_t ChildrenOfNode = 4;
  using Lanes = MedialVoxelLanesOf<float, ChildrenOfNode>;

  /** The boxes of its children side by side. */
  struct Node
  {
    std::array<Lanes, 3>              low;
    std::array<Lanes, 3>              high;
    std::array<Index, ChildrenOfNode> first{}; ///< triangle of a leaf in the order of the tree, or the node
    std::array<Index, ChildrenOfNode> count{}; ///< of the triangles of a leaf; 0: the child is a node
  };

  class Builder;

  struct Query
  {
    Point                point;
    std::array<Lanes, 3> below; ///< the point in single precision, rounded down
    std::array<Lanes, 3> above;
    double               enough; ///< a squared distance: the search ends at the first one below it

    Query(const Point & place, double enoughDistance2);
  };

  /** \a best has the square of the distance and the place in the tree. */
  void
  Search(Index node, const Query & query, Nearest & best) const;

  void
  SearchLeaf(Index first, Index count, const Query & query, Nearest & best) const;

  const std::vector<Point> * m_Points;
  std::vector<Triangle>      m_Triangles; ///< in the order of the tree
  std::vector<Index>         m_Order;     ///< their places in the order they were given in
  std::vector<Node>          m_Nodes;
  std::vector<Index>         m_Roots;
};

} // end namespace itk

#endif
