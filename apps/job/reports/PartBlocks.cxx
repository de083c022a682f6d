// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PartBlocks.h"

#include <algorithm>
#include <iterator>

namespace medialvoxel
{
namespace
{

using WordType = itk::MedialVoxelBits::WordType;

constexpr std::uint64_t MostBlocks = 128; // along an axis
constexpr unsigned int  MostSamples = 2;  // along an edge, as a power of two

/** Numbers of blocks of two to the power of \a level voxels that a box covers. */
itk::MedialVoxelBox
GetBlocks(const itk::MedialVoxelBox & box, unsigned int level)
{
  itk::MedialVoxelBox blocks;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    blocks.lower[axis] = box.lower[axis] >> level;
    blocks.upper[axis] = ((box.upper[axis] - 1) >> level) + 1;
  }
  return blocks;
}

bool
IsInside(std::uint8_t share)
{
  return share >= PartBlocks::Grid::LeastInside;
}

/** Calls function(one, other) for the blocks at each face between inside and outside. All is outside beyond the grid,
 * where there is no other. */
template <typename TFunction>
void
ForEachFace(const PartBlocks::Grid & grid, TFunction && function)
{
  std::size_t stride = 1;
  for (unsigned int axis = 0; axis < 3; stride *= grid.blocks[axis], ++axis)
  {
    for (std::size_t at = 0; at < grid.shares.size(); ++at)
    {
      const std::size_t index = at / stride % grid.blocks[axis];
      const std::size_t before = index > 0 ? at - stride : at;
      const bool        isInside = IsInside(grid.shares[at]);
      if (index > 0 ? isInside != IsInside(grid.shares[before]) : isInside)
      {
        function(at, before);
      }
      if (isInside && index + 1 == grid.blocks[axis])
      {
        function(at, at);
      }
    }
  }
}

std::size_t
CountFaces(const PartBlocks::Grid & grid)
{
  std::size_t faces = 0;
  ForEachFace(grid, [&faces](std::size_t, std::size_t) { ++faces; });
  return faces;
}

/** Shares away from the surface, which do not move it, become none or all. */
void
DropOtherShares(PartBlocks::Grid & grid)
{
  std::vector<bool> isAtFace(grid.shares.size());
  ForEachFace(grid, [&isAtFace](std::size_t one, std::size_t other) { isAtFace[one] = isAtFace[other] = true; });
  for (std::size_t at = 0; at < grid.shares.size(); ++at)
  {
    if (!isAtFace[at])
    {
      grid.shares[at] = IsInside(grid.shares[at]) ? PartBlocks::Grid::MostShare : 0;
    }
  }
}

} // namespace

PartBlocks::PartBlocks(const std::vector<std::uint64_t> & size)
{
  itk::MedialVoxelBox volume{ { { 0, 0, 0 } }, { { 1, 1, 1 } } };
  std::copy(size.begin(), size.end(), volume.upper.begin());
  while ((*std::max_element(size.begin(), size.end()) - 1) >> m_Level >= MostBlocks)
  {
    ++m_Level;
  }
  m_StepLevel = m_Level - std::min(m_Level, MostSamples);
  m_Blocks = GetBlocks(volume, m_Level);
  m_Counts.resize(static_cast<std::size_t>(m_Blocks.NumberOfVoxels()));
}

PartBlocks::PartBlocks(const PartBlocks & volume, const itk::MedialVoxelBox & tile)
  : m_Level(volume.m_Level)
  , m_StepLevel(volume.m_StepLevel)
  , m_Blocks(GetBlocks(tile, m_Level))
  , m_Counts(static_cast<std::size_t>(m_Blocks.NumberOfVoxels()))
{}

void
PartBlocks::Clear()
{
  std::fill(m_Counts.begin(), m_Counts.end(), std::uint8_t{ 0 });
}

void
PartBlocks::Count(const itk::MedialVoxelClassifiedTile & tile)
{
  const std::int64_t between = (std::int64_t{ 1 } << m_StepLevel) - 1;
  for (const itk::MedialVoxelCellRow & row : tile.rows)
  {
    const auto & [x, y, z] = row.first;
    if (((y | z) & between) != 0)
    {
      continue;
    }
    const WordType       object = tile.window.object->Extract(x, y, z) & row.candidates;
    std::uint8_t * const counts = &m_Counts[m_Blocks.OffsetOf({ { m_Blocks.lower[0], y >> m_Level, z >> m_Level } })];
    for (WordType rest = object; rest != 0; rest &= rest - 1)
    {
      const std::int64_t at = x + itk::MedialVoxelLowestBit(rest);
      std::uint8_t &     count = counts[(at >> m_Level) - m_Blocks.lower[0]];
      count = static_cast<std::uint8_t>(count + ((at & between) == 0 ? 1 : 0));
    }
  }
}

void
PartBlocks::Add(const PartBlocks & other)
{
  // Objects of a label map may share filled pores.
  const unsigned int most = 1u << 3 * (m_Level - m_StepLevel);
  auto               count = other.m_Counts.begin();
  const auto &       from = other.m_Blocks;
  for (std::int64_t z = from.lower[2]; z < from.upper[2]; ++z)
  {
    for (std::int64_t y = from.lower[1]; y < from.upper[1]; ++y)
    {
      std::uint8_t * sum = &m_Counts[m_Blocks.OffsetOf({ { from.lower[0], y, z } })];
      for (std::int64_t x = from.lower[0]; x < from.upper[0]; ++x, ++count, ++sum)
      {
        *sum = static_cast<std::uint8_t>(std::min<unsigned int>(*sum + *count, most));
      }
    }
  }
}

auto
PartBlocks::MakeGrid(const SheetPoints & sheet, std::size_t budget) const -> Grid
{
  constexpr std::uint64_t halvesOfBlock = 2;
  std::uint64_t           halves = std::max(halvesOfBlock, (halvesOfBlock << sheet.GetLevel()) >> m_Level);
  Grid                    grid = this->MakeGridOf(sheet, halves);
  while (CountFaces(grid) > budget)
  {
    grid = this->MakeGridOf(sheet, ++halves);
  }
  DropOtherShares(grid);
  return grid;
}

/** \param halves of a block along the edge of a block of the grid */
auto
PartBlocks::MakeGridOf(const SheetPoints & sheet, std::uint64_t halves) const -> Grid
{
  Grid grid;
  grid.halfEdges = halves << m_Level;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    grid.blocks[axis] = (2 * static_cast<std::uint64_t>(m_Blocks.upper[axis]) - 1) / halves + 1;
  }
  const auto offsetOf = [&grid](std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (z * grid.blocks[1] + y) * grid.blocks[0] + x;
  };
  std::vector<std::uint64_t> sums(grid.blocks[0] * grid.blocks[1] * grid.blocks[2]);
  auto                       count = m_Counts.begin();
  for (std::int64_t z = 0; z < m_Blocks.upper[2]; ++z)
  {
    for (std::int64_t y = 0; y < m_Blocks.upper[1]; ++y)
    {
      for (std::int64_t x = 0; x < m_Blocks.upper[0]; ++x, ++count)
      {
        for (unsigned int octant = 0; *count > 0 && octant < 8; ++octant)
        {
          const auto indexOf = [&](std::int64_t block, unsigned int axis) {
            return (2 * static_cast<std::uint64_t>(block) + (octant >> axis & 1)) / halves;
          };
          sums[offsetOf(indexOf(x, 0), indexOf(y, 1), indexOf(z, 2))] += *count;
        }
      }
    }
  }
  const std::uint64_t most = halves * halves * halves << 3 * (m_Level - m_StepLevel);
  std::transform(sums.begin(), sums.end(), std::back_inserter(grid.shares), [most](std::uint64_t sum) {
    return static_cast<std::uint8_t>((sum * Grid::MostShare + most / 2) / most);
  });
  constexpr std::uint8_t leastAtSheet = 11; // a wall of two thirds of a block
  sheet.ForEachPoint([&](const SheetPoints::Point & point) {
    // The corners of the mean cell are voxels; the one with most object around it is in the wall.
    std::uint8_t * fullest = nullptr;
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      const auto indexOf = [&](unsigned int axis) {
        const std::uint64_t index = point.sums.index[axis] + (corner >> axis & 1) * point.sums.cells;
        return std::min(2 * index / (point.sums.cells * grid.halfEdges), grid.blocks[axis] - 1);
      };
      std::uint8_t & share = grid.shares[offsetOf(indexOf(0), indexOf(1), indexOf(2))];
      fullest = fullest == nullptr || share > *fullest ? &share : fullest;
    }
    *fullest = std::max(*fullest, leastAtSheet);
  });
  return grid;
}

void
PartBlocks::Save(NumberWriter & numbers) const
{
  std::for_each(m_Counts.begin(), m_Counts.end(), [&numbers](std::uint8_t count) { numbers.Add(count); });
}

void
PartBlocks::Merge(NumberReader & numbers)
{
  PartBlocks saved(*this);
  for (std::uint8_t & count : saved.m_Counts)
  {
    const std::uint64_t number = numbers.Get();
    if (number > std::uint64_t{ 1 } << 3 * (m_Level - m_StepLevel))
    {
      RefuseSaved();
    }
    count = static_cast<std::uint8_t>(number);
  }
  this->Add(saved);
}

} // end namespace medialvoxel
