// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetPoints_h
#define medialvoxelSheetPoints_h

#include "PackedNumbers.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelGrid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace medialvoxel
{

/** \class SheetPoints
 * \brief Medial cells put together by cubic blocks, a point of a sheet for each block that has any.
 *
 * The edge of the blocks, in voxels, is the smallest power of two that leaves no more than a budget of points. It grows
 * while cells are added: blocks of the smaller edge are in one of the larger edge, and a part of the cells that needs
 * an edge shows that all of them do. All else is sums of whole numbers. So the result does not depend on the order. */
class SheetPoints
{
public:
  /** Points of a sheet that is shown have about two triangles each. */
  static constexpr std::size_t DefaultBudget = 65536;

  /** Sums over the cells of a block. */
  struct Sums
  {
    std::uint64_t                cells{ 0 };
    std::array<std::uint64_t, 3> index{};        ///< sums of their indices
    std::uint64_t                thickness{ 0 }; ///< sum over cells with a thickness, in a unit of the caller
    std::uint64_t                measured{ 0 };  ///< cells with a thickness
    std::uint64_t                unpaired{ 0 };  ///< measured ones of walls without a thickness

    void
    Add(const Sums & other);
  };

  /** The block at a place. */
  struct Point
  {
    std::array<std::uint64_t, 3> block; ///< index of the block along each axis
    const Sums &                 sums;
    std::uint64_t                importance; ///< the largest one, in the unit of the thickness; 0 where it is not found
  };

  /** \param size   of the image, in voxels
   * \param budget of points, below 2^32 - 1 */
  explicit SheetPoints(const std::vector<std::uint64_t> & size, std::size_t budget = DefaultBudget);

  /** Forgets the cells. \param level of the blocks from now on, when it is above the least one */
  void
  Clear(unsigned int level = 0);

  /** Adds cells of the block that \a cell is in. */
  void
  Add(const itk::MedialVoxelIndex & cell, const Sums & sums, std::uint64_t importance = 0);

  /** Adds all cells of another one of the same image and budget. */
  void
  Add(const SheetPoints & other);

  /** The edge of a block is two to this power, in voxels. */
  unsigned int
  GetLevel() const
  {
    return m_Level;
  }

  std::size_t
  GetNumberOfPoints() const
  {
    return m_Blocks.size();
  }

  /** Number of blocks along each axis. */
  std::array<std::uint64_t, 3>
  GetNumberOfBlocks() const;

  /** By z, y, x of the block. */
  void
  ForEachPoint(const std::function<void(const Point & point)> & function) const;

  /** Of each point, in this order, the smallest number above 0 of cells in its block; 0: there is none.
   * \param numbers of the cells, 0 for none */
  std::vector<std::uint32_t>
  FindNumbers(const std::vector<std::array<std::int32_t, 3>> & cells, const std::vector<std::uint32_t> & numbers) const;

  void
  Save(NumberWriter & numbers) const;

  /** Merges saved points. \throw JobError Failure when the numbers do not fit */
  void
  Merge(NumberReader & numbers);

  /** Numbers that Save() writes, at most. */
  std::uint64_t
  GetMostNumbers() const;

  /** Memory that it takes, also while the blocks grow, or while it goes through them in their order. */
  static std::uint64_t
  GetBytes(const VolumeGeometry & geometry, bool hasImportance, std::size_t budget = DefaultBudget);

private:
  using KeyType = std::uint64_t;

  struct Block
  {
    KeyType key;
    Sums    sums;
  };

  static KeyType
  GetKey(const std::array<std::uint64_t, 3> & block);

  static std::array<std::uint64_t, 3>
  GetBlock(KeyType key);

  void
  AddAt(std::array<std::uint64_t, 3> block, unsigned int level, const Sums & sums, std::uint64_t importance);

  void
  CoarsenTo(unsigned int level);

  std::uint32_t &
  FindNumber(KeyType key);

  void
  AddToBlock(KeyType key, const Sums & sums, std::uint64_t importance);

  std::uint64_t
  GetImportance(std::size_t block) const
  {
    return m_Importance.empty() ? 0 : m_Importance[block];
  }

  void
  MakeRoom();

  std::array<std::uint64_t, 3> m_Size{ { 1, 1, 1 } };
  std::size_t                  m_Budget;
  unsigned int                 m_Level{ 0 };
  std::vector<Block>           m_Blocks;
  std::vector<std::uint64_t>   m_Importance; // of the blocks; empty while all are 0
  std::vector<std::uint32_t>   m_Numbers;    // of blocks from 1 on, hashed by their keys; 0: none
  unsigned int                 m_Shift{ 0 };
};

} // end namespace medialvoxel

#endif
