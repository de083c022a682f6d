// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceJoiner.h"

#include "gtest/gtest.h"

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <tuple>
#include <vector>

namespace
{

using namespace medialvoxel;

using Cells = std::map<std::int64_t, PlaceCell>;
using Row = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t, std::int64_t, float, float, std::uint64_t>;
using Rows = std::vector<Row>;

constexpr float Limit = 4.0f;
constexpr float GrowLimit = 6.0f;

PlaceRule
MakeRule(PlaceKind kind)
{
  PlaceRule rule;
  rule.kind = kind;
  rule.limit = static_cast<double>(kind == PlaceKind::Thin ? Limit : GrowLimit);
  rule.growLimit = static_cast<double>(kind == PlaceKind::Thin ? GrowLimit : Limit);
  rule.minimumPlaceArea = 3;
  rule.lengthUnit = 1.0 / 64;
  return rule;
}

Row
MakeRow(const PlaceSums & sums)
{
  return { sums.areaBeyond, sums.cells, sums.thickness, sums.worst.key, sums.minimum, sums.maximum, sums.area };
}

Rows
ListRows(PlaceList list)
{
  Rows       rows;
  const auto places = list.TakeSorted();
  std::transform(places.begin(), places.end(), std::back_inserter(rows), MakeRow);
  return rows;
}

/** By a flood fill over all cells. */
Rows
FindRows(Cells cells, const PlaceRule & rule, const PlaceGrid & grid)
{
  Rows rows;
  while (!cells.empty())
  {
    std::vector<PlaceCell> border{ cells.begin()->second };
    cells.erase(cells.begin());
    PlaceSums sums;
    while (!border.empty())
    {
      const PlaceCell cell = border.back();
      border.pop_back();
      sums.Add(cell, rule, grid);
      const itk::MedialVoxelIndex at = grid.GetCell(cell.key);
      for (int step = 0; step < 27; ++step)
      {
        const itk::MedialVoxelIndex next{ { at[0] + step % 3 - 1, at[1] + step / 3 % 3 - 1, at[2] + step / 9 - 1 } };
        const auto                  found = std::find_if(
          cells.begin(), cells.end(), [&](const auto & other) { return grid.GetCell(other.first) == next; });
        if (found != cells.end())
        {
          border.push_back(found->second);
          cells.erase(found);
        }
      }
    }
    if (sums.hasBegun && sums.areaBeyond >= rule.minimumPlaceArea)
    {
      rows.push_back(MakeRow(sums));
    }
  }
  std::sort(rows.begin(), rows.end(), [](const Row & a, const Row & b) {
    return std::get<0>(a) != std::get<0>(b) ? std::get<0>(a) > std::get<0>(b) : std::get<3>(a) < std::get<3>(b);
  });
  return rows;
}

/** Cuts of a length, from 0 to its end. */
std::vector<std::int64_t>
CutRandomly(std::int64_t length, std::mt19937 & random)
{
  std::vector<std::int64_t> cuts{ 0 };
  while (cuts.back() < length)
  {
    cuts.push_back(std::min(length, cuts.back() + 1 + static_cast<std::int64_t>(random() % 4)));
  }
  return cuts;
}

class PlaceJoinerTest : public testing::TestWithParam<int>
{
protected:
  void
  SetUp() override
  {
    m_Random.seed(static_cast<unsigned int>(this->GetParam()));
    m_Dimension = this->GetParam() % 3 == 0 ? 2 : 3;
    m_Size = { { 2 + static_cast<std::int64_t>(m_Random() % 9),
                 2 + static_cast<std::int64_t>(m_Random() % 9),
                 m_Dimension == 2 ? 1 : 1 + static_cast<std::int64_t>(m_Random() % 9) } };
    m_Grid = std::make_unique<PlaceGrid>(m_Size, m_Dimension);
    m_Rule = MakeRule(this->GetParam() % 2 == 0 ? PlaceKind::Thin : PlaceKind::Thick);
    const auto oneOf = 2 + m_Random() % 12;
    for (std::int64_t i = 0; i < m_Size[0] * m_Size[1] * m_Size[2]; ++i)
    {
      if (m_Random() % oneOf == 0)
      {
        PlaceCell cell;
        cell.key = m_Grid->GetKey({ { i % m_Size[0], i / m_Size[0] % m_Size[1], i / m_Size[0] / m_Size[1] } });
        cell.thickness = Limit - 1 + 0.25f * static_cast<float>(m_Random() % 17);
        cell.area = static_cast<std::uint32_t>(1 + m_Random() % 3);
        if (m_Rule.Grows(static_cast<double>(cell.thickness)))
        {
          m_Cells[cell.key] = cell;
        }
      }
    }
  }

  /** The regions of a range of slices, by rows where the image has slices of them. */
  void
  AddSlices(PlaceJoiner & clusters, std::int64_t begin, std::int64_t end)
  {
    const unsigned int last = m_Dimension - 1;
    const auto         slices = CutRandomly(end - begin, m_Random);
    for (std::size_t i = 0; i + 1 < slices.size(); ++i)
    {
      const auto rows = m_Dimension == 3 ? CutRandomly(m_Size[1], m_Random) : std::vector<std::int64_t>{ 0, 1 };
      for (std::size_t j = 0; j + 1 < rows.size(); ++j)
      {
        itk::MedialVoxelBox region{ {}, m_Size };
        region.lower[last] = begin + slices[i];
        region.upper[last] = begin + slices[i + 1];
        if (m_Dimension == 3)
        {
          region.lower[1] = rows[j];
          region.upper[1] = rows[j + 1];
        }
        this->AddRegion(clusters, region);
      }
    }
  }

  void
  AddRegion(PlaceJoiner & clusters, const itk::MedialVoxelBox & region)
  {
    std::vector<PlaceCell> cells;
    for (const auto & [key, cell] : m_Cells)
    {
      const itk::MedialVoxelIndex index = m_Grid->GetCell(key);
      const auto                  isInside = [&](unsigned int axis) {
        return index[axis] >= region.lower[axis] && index[axis] < region.upper[axis];
      };
      if (isInside(0) && isInside(1) && isInside(2))
      {
        cells.push_back(cell);
      }
    }
    std::shuffle(cells.begin(), cells.end(), m_Random);
    clusters.Add({ cells.begin(), cells.end() }, region);
  }

  std::mt19937               m_Random;
  unsigned int               m_Dimension{ 3 };
  itk::MedialVoxelIndex      m_Size{};
  std::unique_ptr<PlaceGrid> m_Grid;
  PlaceRule                  m_Rule;
  Cells                      m_Cells;
};

TEST_P(PlaceJoinerTest, AreThoseOfAFloodFillForAnyRegions)
{
  const Rows  expected = FindRows(m_Cells, m_Rule, *m_Grid);
  PlaceJoiner clusters(m_Rule, *m_Grid);
  for (int repeat = 0; repeat < 3; ++repeat)
  {
    this->AddSlices(clusters, 0, m_Size[m_Dimension - 1]);
    EXPECT_EQ(ListRows(clusters.Finish()), expected);
    clusters.Clear();
  }
}

TEST_P(PlaceJoinerTest, ArePutTogetherFromSlices)
{
  const auto  cuts = CutRandomly(m_Size[m_Dimension - 1], m_Random);
  PlaceJoiner all(m_Rule, *m_Grid);
  PlaceJoiner part(m_Rule, *m_Grid);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    part.Clear();
    this->AddSlices(part, cuts[i], cuts[i + 1]);
    NumberWriter numbers;
    part.Save(numbers);
    const std::string bytes = numbers.Pack();
    NumberReader      reader(bytes, std::uint64_t{ 1 } << 20);
    all.Merge(reader);
    EXPECT_NO_THROW(reader.CheckEnd());
  }
  EXPECT_EQ(ListRows(all.Finish()), FindRows(m_Cells, m_Rule, *m_Grid));
}

INSTANTIATE_TEST_SUITE_P(Random, PlaceJoinerTest, testing::Range(0, 300));

TEST(MedialVoxelPlaceList, KeepsTheLargestInAnyOrder)
{
  const PlaceRule        rule = MakeRule(PlaceKind::Thin);
  std::vector<PlaceSums> places(PlaceList::MostPlaces + 500);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    places[i].cells = 1;
    places[i].hasBegun = true;
    places[i].area = places[i].areaBeyond = 3 + i % 97;
    places[i].worst.key = static_cast<std::int64_t>(i);
  }
  Rows         expected;
  std::mt19937 random(5);
  for (int repeat = 0; repeat < 3; ++repeat)
  {
    PlaceList list;
    std::shuffle(places.begin(), places.end(), random);
    for (const PlaceSums & place : places)
    {
      list.Add(place, rule);
    }
    EXPECT_EQ(list.GetTotals().number, places.size());
    const Rows rows = ListRows(list);
    EXPECT_EQ(rows.size(), PlaceList::MostPlaces);
    EXPECT_TRUE(expected.empty() || rows == expected);
    expected = rows;
  }
  EXPECT_EQ(std::get<0>(expected.front()), 99);
}

} // namespace
