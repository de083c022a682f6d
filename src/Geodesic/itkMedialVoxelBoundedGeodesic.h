// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBoundedGeodesic_h
#define itkMedialVoxelBoundedGeodesic_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelBoundaryDistances.h"
#include "itkMedialVoxelDualCell.h"
#include "itkMedialVoxelGeodesicLandmarks.h"

#include <cstdint>

namespace itk
{

/** \class MedialVoxelBoundedGeodesic
 * \brief Decides whether the geodesic distance between two boundary points reaches a threshold.
 *
 * The graph joins boundary points that differ by at most 1 along each axis, with physical edge lengths. A path shorter
 * than the threshold stays inside the ellipsoid with the two points as foci and the threshold as axis sum, so that only
 * its bounding box is read (the paper uses the box of its bounding sphere, Fig. 7).
 *
 * Near points are flooded with bit operations first: the number of edges of the shortest path bounds its length from
 * both sides. Points in different components of a graph that many searches share are apart; the triangle inequality
 * with the results of earlier searches decides most others. The rest is searched by Dijkstra's algorithm, whose result
 * serves later searches. Lengths that lie within rounding of the threshold are resolved by enumerating the edge counts
 * of the paths in question, so that the answer is always the one of the definition: the smallest MedialVoxelPathLength
 * of all paths.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBoundedGeodesic
{
public:
  /** \class Workspace
   * \brief Memory of one thread, and results of earlier searches on the same boundary.
   * \ingroup MedialVoxel
   */
  class Workspace;

  /** \a epsilon is the threshold in physical units, positive and finite. */
  MedialVoxelBoundedGeodesic(const MedialVoxelGrid & grid, double epsilon);

  /** Box of all points on paths from \a a to \a b that are not longer than \a length, in the image. It holds both
   * points whenever a path may exist; their order does not matter. */
  static MedialVoxelBox
  SearchBoxOf(const MedialVoxelGrid & grid, const MedialVoxelIndex & a, const MedialVoxelIndex & b, double length);

  /** A length for which \a box, which holds both points, holds SearchBoxOf(): nearly the largest one, infinite when it
   * is the image. */
  static double
  LengthWithin(const MedialVoxelGrid &  grid,
               const MedialVoxelIndex & a,
               const MedialVoxelIndex & b,
               const MedialVoxelBox &   box);

  /** Voxels that ReachesThreshold() reads. */
  MedialVoxelBox
  GetSearchBox(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const;

  /** Begin a series of searches on \a boundary, which must stay as it is meanwhile, most of them near \a tile. */
  void
  Begin(const MedialVoxelBits & boundary, const MedialVoxelBox & tile, Workspace & workspace) const;

  /** True when every path from \a a to \a b on the boundary is at least as long as the threshold, or none exists.
   *
   * \a a and \a b are boundary points; the box of the boundary holds GetSearchBox(a, b). */
  bool
  ReachesThreshold(const MedialVoxelIndex & a, const MedialVoxelIndex & b, Workspace & workspace) const;

  /** Bytes that a workspace grows to when an eighth of the voxels of the largest search box are boundary points. */
  static std::uint64_t
  GetBytes(const MedialVoxelGrid & grid, double epsilon);

private:
  enum class FloodResult
  {
    Reaches,
    FallsShort,
    Undecided
  };

  FloodResult
  Flood(const MedialVoxelBits &  boundary,
        const MedialVoxelBox &   searchBox,
        const MedialVoxelIndex & a,
        const MedialVoxelIndex & b) const;

  bool
  Search(const MedialVoxelIndex & a,
         const MedialVoxelIndex & b,
         const MedialVoxelBox &   searchBox,
         Workspace &              workspace) const;

  double
  ResolveLength(const MedialVoxelBoundaryGraph &   graph,
                MedialVoxelBoundaryGraph::NodeType a,
                MedialVoxelBoundaryGraph::NodeType b,
                MedialVoxelBoundaryDistances &     distances) const;

  MedialVoxelGrid     m_Grid;
  MedialVoxelDualCell m_Cell;
  double              m_Epsilon;

  /** Lengths from m_Lower to m_Upper are too near to epsilon for sums in floating point to be trusted. */
  double m_Lower;
  double m_Upper;

  /** Searches go on to a radius where their results are to serve other pairs too. */
  bool   m_HasLandmarks;
  double m_Radius;

  /** Most boundary points in a graph for a whole tile. */
  std::size_t m_MostNodesOfTile;
};

class MedialVoxel_EXPORT MedialVoxelBoundedGeodesic::Workspace
{
private:
  friend class MedialVoxelBoundedGeodesic;

  /** Boundary points that several searches share. */
  struct Region
  {
    MedialVoxelBoundaryGraph     graph;
    MedialVoxelGeodesicLandmarks landmarks;

    bool
    Build(const MedialVoxelBits & boundary, const MedialVoxelBox & box, std::size_t mostNodes);
  };

  /** The region around the tile when it holds \a searchBox, otherwise one around the box itself. */
  Region &
  GetRegion(const MedialVoxelBox & searchBox);

  const MedialVoxelBits *      m_Boundary{ nullptr };
  MedialVoxelBox               m_TileBox;
  std::size_t                  m_MostNodesOfTile{ 0 };
  Region                       m_Tile;
  Region                       m_Elsewhere;
  MedialVoxelBoundaryDistances m_Distances;
};

} // end namespace itk

#endif
