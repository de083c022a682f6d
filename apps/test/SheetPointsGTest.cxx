// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "SheetPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>

using namespace medialvoxel;

namespace
{

const std::vector<std::uint64_t> Size{ 300, 200, 150 };

using Block = std::array<std::uint64_t, 3>;

struct Cell
{
  itk::MedialVoxelIndex index;
  SheetPoints::Sums     sums;
  std::uint64_t         importance{ 0 };
};

SheetPoints::Sums
MakeSums(const itk::MedialVoxelIndex & cell, std::uint64_t thickness)
{
  SheetPoints::Sums sums;
  sums.cells = 1;
  std::copy(cell.begin(), cell.end(), sums.index.begin());
  sums.thickness = thickness;
  sums.measured = thickness > 0 ? 1 : 0;
  sums.unpaired = 1 - sums.measured;
  return sums;
}

/** A plane that is tilted, and cells anywhere; none twice. */
std::vector<Cell>
MakeCells(unsigned int number)
{
  std::mt19937                    random(7);
  std::set<itk::MedialVoxelIndex> indices;
  while (indices.size() < number)
  {
    const auto x = static_cast<std::int64_t>(random() % Size[0]);
    const auto y = static_cast<std::int64_t>(random() % Size[1]);
    const bool isPlane = random() % 4 != 0;
    const auto z = isPlane ? (x + y) / 4 : static_cast<std::int64_t>(random() % Size[2]);
    indices.insert({ { x, y, z } });
  }
  std::vector<Cell> cells;
  for (const itk::MedialVoxelIndex & index : indices)
  {
    // The first ones have none.
    const bool isImportant = cells.size() > number / 4 && random() % 3 == 0;
    cells.push_back({ index, MakeSums(index, random() % 5 * 64), isImportant ? random() % 1000 : 0 });
  }
  return cells;
}

/** Blocks and sums as (cells, sums of indices, thickness, measured, unpaired), and importance, by z, y, x. */
using Rows =
  std::vector<std::tuple<Block, std::uint64_t, Block, std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t>>;

Rows
MakeRows(const SheetPoints & points)
{
  Rows rows;
  points.ForEachPoint([&](const SheetPoints::Point & point) {
    const SheetPoints::Sums & sums = point.sums;
    rows.emplace_back(
      point.block, sums.cells, sums.index, sums.thickness, sums.measured, sums.unpaired, point.importance);
  });
  return rows;
}

/** The same by the definition: the smallest power of two, then sums by blocks. */
Rows
MakeExpectedRows(const std::vector<Cell> & cells, std::size_t budget, unsigned int & level)
{
  std::map<Block, Cell> blocks; // by z, y, x
  for (level = 0;; ++level)
  {
    blocks.clear();
    for (const Cell & cell : cells)
    {
      Block block{};
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        block[2 - axis] = static_cast<std::uint64_t>(cell.index[axis]) / (std::uint64_t{ 1 } << level);
      }
      blocks[block].sums.Add(cell.sums);
      blocks[block].importance = std::max(blocks[block].importance, cell.importance);
    }
    if (blocks.size() <= budget)
    {
      break;
    }
  }
  Rows rows;
  for (const auto & [block, cell] : blocks)
  {
    const SheetPoints::Sums & sums = cell.sums;
    rows.emplace_back(Block{ { block[2], block[1], block[0] } },
                      sums.cells,
                      sums.index,
                      sums.thickness,
                      sums.measured,
                      sums.unpaired,
                      cell.importance);
  }
  return rows;
}

SheetPoints
Collect(const std::vector<Cell> & cells, std::size_t budget)
{
  SheetPoints points(Size, budget);
  for (const Cell & cell : cells)
  {
    points.Add(cell.index, cell.sums, cell.importance);
  }
  return points;
}

void
Merge(SheetPoints & points, const SheetPoints & part)
{
  NumberWriter writer;
  part.Save(writer);
  NumberReader reader(writer.Pack(), 10 * part.GetMostNumbers());
  points.Merge(reader);
  reader.CheckEnd();
}

} // namespace

TEST(SheetPoints, AreSumsByTheSmallestBlocksThatKeepTheBudget)
{
  std::vector<Cell> cells = MakeCells(20000);
  std::mt19937      random(3);
  for (const std::size_t budget : { 1u, 2u, 50u, 1000u, 5000u, 19999u, 20000u, 100000u })
  {
    unsigned int level = 0;
    const Rows   expected = MakeExpectedRows(cells, budget, level);
    for (unsigned int order = 0; order < 3; ++order)
    {
      const SheetPoints points = Collect(cells, budget);
      EXPECT_EQ(points.GetLevel(), level) << budget;
      EXPECT_EQ(MakeRows(points), expected) << budget;
      std::shuffle(cells.begin(), cells.end(), random);
    }
  }
}

TEST(SheetPoints, OfPartsAreThoseOfTheWhole)
{
  const std::vector<Cell> cells = MakeCells(20000);
  constexpr std::size_t   budget = 3000;
  const Rows              expected = MakeRows(Collect(cells, budget));
  // Parts of different sizes have different edges.
  for (const std::size_t first : { std::size_t{ 0 }, std::size_t{ 100 }, std::size_t{ 7000 }, cells.size() })
  {
    const auto        middle = cells.begin() + static_cast<std::ptrdiff_t>(first);
    const SheetPoints one = Collect({ cells.begin(), middle }, budget);
    const SheetPoints other = Collect({ middle, cells.end() }, budget);
    for (const bool isSwapped : { false, true })
    {
      SheetPoints merged(Size, budget);
      Merge(merged, isSwapped ? other : one);
      Merge(merged, isSwapped ? one : other);
      EXPECT_EQ(MakeRows(merged), expected);
      SheetPoints added = isSwapped ? other : one;
      added.Add(isSwapped ? one : other);
      EXPECT_EQ(MakeRows(added), expected);
    }
  }
}

TEST(SheetPoints, HaveTheSmallestNumbersOfTheirCells)
{
  const std::vector<Cell>                  cells = MakeCells(20000);
  std::mt19937                             random(5);
  std::vector<std::array<std::int32_t, 3>> numbered;
  std::vector<std::uint32_t>               numbers;
  for (const Cell & cell : cells)
  {
    const auto [x, y, z] = cell.index;
    numbered.push_back(
      { { static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z) } });
    numbers.push_back(static_cast<std::uint32_t>(random() % 4));
  }
  for (const std::size_t budget : { 50u, 5000u, 20000u })
  {
    const SheetPoints              points = Collect({ cells.begin() + 5000, cells.end() }, budget);
    std::map<Block, std::uint32_t> least;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      Block block{};
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        block[axis] = static_cast<std::uint64_t>(numbered[i][axis]) / (std::uint64_t{ 1 } << points.GetLevel());
      }
      std::uint32_t & number = least[block];
      number = numbers[i] > 0 && (number == 0 || numbers[i] < number) ? numbers[i] : number;
    }
    std::vector<std::uint32_t> expected;
    points.ForEachPoint([&](const SheetPoints::Point & point) { expected.push_back(least.at(point.block)); });
    EXPECT_EQ(points.FindNumbers(numbered, numbers), expected) << budget;
  }
}

TEST(SheetPoints, OfAnotherImageOrTooManyAreRefused)
{
  const SheetPoints points = Collect(MakeCells(2000), 1000);
  NumberWriter      writer;
  points.Save(writer);
  const std::string bytes = writer.Pack();
  for (SheetPoints other : { SheetPoints({ 40, 200, 150 }, 1000), SheetPoints(Size, 10) })
  {
    NumberReader reader(bytes, 10 * points.GetMostNumbers());
    EXPECT_THROW(other.Merge(reader), JobError);
  }
}

TEST(SheetPoints, AreForgotten)
{
  const std::vector<Cell> cells = MakeCells(2000);
  SheetPoints             points = Collect(cells, 100);
  points.Clear();
  EXPECT_EQ(points.GetNumberOfPoints(), 0u);
  EXPECT_EQ(points.GetLevel(), 0u);
  points.Add(cells.front().index, cells.front().sums);
  EXPECT_EQ(points.GetNumberOfPoints(), 1u);
}

TEST(SheetPoints, OfVeryLongAxesHaveLargerBlocks)
{
  SheetPoints        points({ std::uint64_t{ 1 } << 30, 1, 1 });
  const std::int64_t last = (std::int64_t{ 1 } << 30) - 2;
  points.Add({ { last, 0, 0 } }, MakeSums({ { last, 0, 0 } }, 1));
  const Rows rows = MakeRows(points);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(std::get<0>(rows[0])[0], static_cast<std::uint64_t>(last) >> points.GetLevel());
}
