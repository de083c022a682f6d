// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPartBlocks_h
#define medialvoxelPartBlocks_h

#include "PackedNumbers.h"
#include "SheetPoints.h"

#include "itkMedialVoxelTileObserver.h"

#include <array>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class PartBlocks
 * \brief Object voxels counted by cubic blocks, of which a page shows the surface of the part.
 *
 * Counts are sums, so the result does not depend on the order. At most 4 x 4 x 4 voxels of a block are looked at. */
class PartBlocks
{
public:
  /** Of a volume: the edge is the least power of two that leaves at most 128 blocks along an axis. */
  explicit PartBlocks(const std::vector<std::uint64_t> & size);

  /** Nothing, of the part of a volume that a tile covers. */
  PartBlocks(const PartBlocks & volume, const itk::MedialVoxelBox & tile);

  void
  Clear();

  /** Counts the object voxels at the cells of the rows; the last ones along an axis have no cell. */
  void
  Count(const itk::MedialVoxelClassifiedTile & tile);

  /** Adds the counts of the same volume or of a part. */
  void
  Add(const PartBlocks & other);

  /** Shares of object in the blocks of a grid, x fastest. */
  struct Grid
  {
    static constexpr unsigned int MostShare = 15;
    static constexpr unsigned int LeastInside = 8;

    std::array<std::uint64_t, 3> blocks{};
    std::uint64_t                halfEdges{ 0 }; ///< half voxels that are an edge
    std::vector<std::uint8_t>    shares;
  };

  /** The finest grid whose surface has at most \a budget quadrilaterals. Blocks with a point of the sheet are inside,
   * so that thin walls do not vanish. */
  Grid
  MakeGrid(const SheetPoints & sheet, std::size_t budget = DefaultBudget) const;

  static constexpr std::size_t DefaultBudget = 30000;

  void
  Save(NumberWriter & numbers) const;

  /** Merges saved counts. \throw JobError Failure when the numbers do not fit */
  void
  Merge(NumberReader & numbers);

  std::uint64_t
  GetNumberOfBlocks() const
  {
    return m_Counts.size();
  }

  /** Memory of making a grid: the sums, shares of two grids, and which of them count. */
  std::uint64_t
  GetBytesOfGrid() const
  {
    return (sizeof(std::uint64_t) + 3) * m_Counts.size();
  }

private:
  Grid
  MakeGridOf(const SheetPoints & sheet, std::uint64_t halves) const;

  unsigned int              m_Level{ 0 }; // the edge is two to this power, in voxels
  unsigned int              m_StepLevel{ 0 };
  itk::MedialVoxelBox       m_Blocks; // x fastest
  std::vector<std::uint8_t> m_Counts;
};

} // end namespace medialvoxel

#endif
