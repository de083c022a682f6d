// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBlockSeparation_h
#define itkMedialVoxelBlockSeparation_h

#include "itkMedialVoxelBoxComponents.h"
#include "itkMedialVoxelLengthBounds.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace itk
{

/** \class MedialVoxelBlockSeparation
 * \brief Finds for many pairs of boundary points how long a path between them is at least.
 *
 * The pairs whose middles lie in one block of voxels share the components of the boundary in a box around the block,
 * which holds all short paths between their points: none joins points in different components. On either side of a wall
 * this decides most pairs for the price of a few words each.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBlockSeparation
{
public:
  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  private:
    friend class MedialVoxelBlockSeparation;

    MedialVoxelBoxComponents   m_Components;
    std::vector<std::uint32_t> m_Blocks; // of the pairs
    std::vector<std::uint32_t> m_Ends;   // of the blocks in the order
    std::vector<std::uint32_t> m_Order;  // of the pairs, block by block
  };

  explicit MedialVoxelBlockSeparation(const MedialVoxelGrid & grid)
    : m_Grid(grid)
  {}

  /** Raise the lower bounds of pairs that a block separates.
   *
   * \param boundary  boundary points; pairs whose box reaches beyond them keep their bounds
   * \param progress  asked for an abort before each block
   * \param pairs     each with the boundary points \c a and \c b, the length \c epsilon up to which paths matter, in
   * physical units, and the \c bounds of their geodesic distance; an \c epsilon of 0 leaves a pair alone */
  template <typename TPair>
  void
  Tighten(const MedialVoxelBits &     boundary,
          const MedialVoxelProgress & progress,
          Workspace &                 workspace,
          std::vector<TPair> &        pairs) const
  {
    this->SortByBlock(workspace, pairs);
    std::uint32_t first = 0;
    for (const std::uint32_t end : workspace.m_Ends)
    {
      if (first != end && !progress.IsAborted())
      {
        MedialVoxelCheckAbort();
        this->TightenBlock(boundary, workspace, first, end, pairs);
      }
      first = end;
    }
  }

private:
  /** Voxels of a block along each axis, as powers of two; rows are words, so that long ones cost nothing. */
  static constexpr std::array<unsigned int, 3> BlockBits{ { 5, 4, 4 } };

  /** The points of the pairs of a block, and how far paths lead from them. */
  struct Extent
  {
    MedialVoxelBox points;
    double         epsilon{ 0.0 };
    double         squaredLength{ std::numeric_limits<double>::infinity() }; // of the shortest pair
  };

  static MedialVoxelIndex
  BlockOf(const MedialVoxelIndex & a, const MedialVoxelIndex & b)
  {
    MedialVoxelIndex block;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      block[axis] = (a[axis] + b[axis]) >> (BlockBits[axis] + 1);
    }
    return block;
  }

  /** Counting sort: there are few blocks. */
  template <typename TPair>
  void
  SortByBlock(Workspace & workspace, const std::vector<TPair> & pairs) const
  {
    MedialVoxelAbortChecker checker;
    MedialVoxelBox          blocks;
    for (const TPair & pair : pairs)
    {
      checker.Count();
      if (pair.epsilon > 0.0)
      {
        Include(BlockOf(pair.a, pair.b), blocks);
      }
    }
    workspace.m_Ends.assign(static_cast<std::size_t>(blocks.NumberOfVoxels()) + 1, 0);
    workspace.m_Blocks.clear();
    for (const TPair & pair : pairs)
    {
      if (pair.epsilon > 0.0)
      {
        const auto block = static_cast<std::uint32_t>(blocks.OffsetOf(BlockOf(pair.a, pair.b)));
        workspace.m_Blocks.push_back(block);
        ++workspace.m_Ends[block + 1];
      }
    }
    // Each block begins where the one before ends, and is filled up to its own end.
    std::partial_sum(workspace.m_Ends.begin(), workspace.m_Ends.end(), workspace.m_Ends.begin());
    workspace.m_Order.resize(workspace.m_Blocks.size());
    auto block = workspace.m_Blocks.begin();
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      checker.Count();
      if (pairs[i].epsilon > 0.0)
      {
        workspace.m_Order[workspace.m_Ends[*block++]++] = static_cast<std::uint32_t>(i);
      }
    }
  }

  template <typename TPair>
  void
  TightenBlock(const MedialVoxelBits & boundary,
               Workspace &             workspace,
               const std::uint32_t     first,
               const std::uint32_t     end,
               std::vector<TPair> &    pairs) const
  {
    Extent extent;
    for (std::uint32_t i = first; i < end; ++i)
    {
      const TPair & pair = pairs[workspace.m_Order[i]];
      Include(pair.a, extent.points);
      Include(pair.b, extent.points);
      extent.epsilon = std::max(extent.epsilon, pair.epsilon);
      extent.squaredLength =
        std::min(extent.squaredLength,
                 m_Grid.SquaredMetricLength(pair.a[0] - pair.b[0], pair.a[1] - pair.b[1], pair.a[2] - pair.b[2]));
    }
    const double         length = extent.epsilon * (1.0 + 2.0 * MedialVoxelResolutionBand);
    const MedialVoxelBox box = this->GetBox(extent, length);
    if (!boundary.GetBox().Contains(box) || box.Extent(0) > MedialVoxelBoxComponents::LongestRow)
    {
      return;
    }
    workspace.m_Components.Label(boundary, box);
    for (std::uint32_t i = first; i < end; ++i)
    {
      TPair & pair = pairs[workspace.m_Order[i]];
      if (!workspace.m_Components.AreConnected(pair.a, pair.b))
      {
        pair.bounds.Tighten({ length });
      }
    }
  }

  /** The box that holds all paths of a block that are shorter than \a length. */
  MedialVoxelBox
  GetBox(const Extent & extent, double length) const;

  /** Extend a box so that it holds an index. */
  static void
  Include(const MedialVoxelIndex & index, MedialVoxelBox & box)
  {
    const bool isFirst = box.IsEmpty();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = isFirst ? index[axis] : std::min(box.lower[axis], index[axis]);
      box.upper[axis] = isFirst ? index[axis] + 1 : std::max(box.upper[axis], index[axis] + 1);
    }
  }

  MedialVoxelGrid m_Grid;
};

} // end namespace itk

#endif
