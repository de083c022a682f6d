// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBoundedGeodesic_h
#define itkMedialVoxelBoundedGeodesic_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelDualCell.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelBoundedGeodesic
 * \brief Decides whether the geodesic distance between two boundary points reaches a threshold.
 *
 * The graph joins boundary points that differ by at most 1 along each axis, with physical edge lengths. A path shorter
 * than the threshold stays inside the ellipsoid with the two points as foci and the threshold as axis sum, so that only
 * its bounding box is read (the paper uses the box of its bounding sphere, Fig. 7).
 *
 * Small boxes are flooded with bit operations first: the number of edges of the shortest path bounds its length from
 * both sides. What that leaves is searched by the A* algorithm with the free-space length as lower bound. Lengths that
 * lie within rounding of the threshold are resolved by enumerating the edge counts of the paths in question, so that
 * the answer is the one of the definition: the smallest MedialVoxelPathLength of all paths.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBoundedGeodesic
{
public:
  /** \class Workspace
   * \brief Memory of one thread, kept from search to search.
   * \ingroup MedialVoxel
   */
  class Workspace;

  /** \a epsilon is the threshold in physical units, positive and finite. */
  MedialVoxelBoundedGeodesic(const MedialVoxelGrid & grid, double epsilon);

  /** Voxels that ReachesThreshold() reads. */
  MedialVoxelBox
  GetSearchBox(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const;

  /** True when every path from \a a to \a b on the boundary is at least as long as the threshold, or none exists.
   *
   * \a a and \a b are boundary points; the box of \a boundary holds GetSearchBox(a, b). */
  bool
  ReachesThreshold(const MedialVoxelBits &  boundary,
                   const MedialVoxelIndex & a,
                   const MedialVoxelIndex & b,
                   Workspace &              workspace) const;

  /** Bytes that a workspace grows to when a quarter of the voxels of the largest search box are boundary points.
   * \param reach  voxels along each axis that have the physical length epsilon / 2 */
  static std::uint64_t
  GetWorkspaceBytes(const MedialVoxelIndex & reach);

private:
  enum class FloodResult
  {
    Reaches,
    FallsShort,
    Undecided
  };

  FloodResult
  Flood(const MedialVoxelBits &  boundary,
        const MedialVoxelBox &   box,
        const MedialVoxelIndex & a,
        const MedialVoxelIndex & b) const;

  double
  ShortestLength(const MedialVoxelIndex & a, const MedialVoxelIndex & b, Workspace & workspace) const;

  double
  ResolveLength(const MedialVoxelIndex & a, const MedialVoxelIndex & b, Workspace & workspace) const;

  MedialVoxelGrid     m_Grid;
  MedialVoxelDualCell m_Cell;
  double              m_Epsilon;

  /** Lengths from m_Lower to m_Upper are too near to epsilon for sums in floating point to be trusted. */
  double m_Lower;
  double m_Upper;
};

/** The boundary points of a search box, numbered in the order x, y, z, and what a search knows about them. */
class MedialVoxel_EXPORT MedialVoxelBoundedGeodesic::Workspace
{
private:
  friend class MedialVoxelBoundedGeodesic;

  struct QueueEntry
  {
    double       bound;
    double       length;
    std::int64_t node;
  };

  /** Copy the boundary bits of \a box and number them. */
  void
  Load(const MedialVoxelBits & boundary, const MedialVoxelBox & box);

  std::int64_t
  NodeOf(const MedialVoxelIndex & index) const;

  /** Call \a visit(node, index, mask) for the boundary points adjacent to \a index. */
  template <typename TVisitor>
  void
  VisitNeighbors(const MedialVoxelIndex & index, TVisitor && visit) const;

  void
  Push(const QueueEntry & entry);

  QueueEntry
  Pop();

  MedialVoxelBox                         m_Box;
  std::int64_t                           m_WordsPerRow{ 0 };
  std::int64_t                           m_NumberOfNodes{ 0 };
  std::vector<MedialVoxelBits::WordType> m_Words;
  std::vector<std::int64_t>              m_NodesBefore;
  std::vector<MedialVoxelIndex>          m_Indices;
  std::vector<double>                    m_Length;
  std::vector<QueueEntry>                m_Queue;
};

} // end namespace itk

#endif
