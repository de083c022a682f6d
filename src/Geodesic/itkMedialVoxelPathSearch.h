// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelPathSearch_h
#define itkMedialVoxelPathSearch_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelBucketQueue.h"
#include "itkMedialVoxelDualCell.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** \class MedialVoxelPathSearch
 * \brief Searches a short path between two boundary points, straight on the bits of a small box.
 *
 * Dijkstra's algorithm, without the points that no short path can use. A path that is short enough ends the search.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelPathSearch
{
public:
  /** Rows of a box are not longer. */
  static constexpr std::int64_t LongestRow = MedialVoxelBits::BitsPerWord - 2;

  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  private:
    friend class MedialVoxelPathSearch;

    struct Node
    {
      double length; // of the shortest path so far
      double rest;   // at least that of the way to the end; negative when it is not known yet
    };

    std::vector<std::uint64_t>           m_Rows;
    std::vector<Node>                    m_Nodes;
    MedialVoxelBucketQueue<std::int32_t> m_Queue;
  };

  explicit MedialVoxelPathSearch(const MedialVoxelGrid & grid);

  /** Length of a path from \a a to \a b inside \a box: of any one that is shorter than \a enough, otherwise of the
   * shortest one, otherwise, when that exceeds \a most, infinity. Sums of edge lengths in floating point.
   *
   * The box of \a boundary holds \a box, and that holds \a a and \a b, which are boundary points. */
  double
  FindLength(const MedialVoxelBits &  boundary,
             const MedialVoxelBox &   box,
             const MedialVoxelIndex & a,
             const MedialVoxelIndex & b,
             double                   enough,
             double                   most,
             Workspace &              workspace) const;

private:
  struct Raster;

  MedialVoxelGrid     m_Grid;
  MedialVoxelDualCell m_Cell;
};

} // end namespace itk

#endif
