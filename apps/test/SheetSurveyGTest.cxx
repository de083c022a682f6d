// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetSurvey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace medialvoxel;

namespace
{

using WordType = itk::MedialVoxelBits::WordType;

constexpr double LengthUnit = 0.25;

/** Rows of random medial cells of a tile, some of them measured. */
struct RandomTile
{
  itk::MedialVoxelBox                  box;
  itk::MedialVoxelBits                 object;
  std::vector<itk::MedialVoxelCellRow> rows;
  std::vector<itk::MedialVoxelWall>    walls;
};

RandomTile
DrawTile(std::mt19937_64 & random, std::int64_t firstX)
{
  RandomTile tile;
  tile.box.lower = { { firstX + static_cast<std::int64_t>(random() % 70),
                       static_cast<std::int64_t>(random() % 30),
                       static_cast<std::int64_t>(random() % 30) } };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    tile.box.upper[axis] = tile.box.lower[axis] + 1 + static_cast<std::int64_t>(random() % 20);
  }
  tile.object.Reshape(tile.box);
  for (std::int64_t z = tile.box.lower[2]; z < tile.box.upper[2]; ++z)
  {
    for (std::int64_t y = tile.box.lower[1]; y < tile.box.upper[1]; ++y)
    {
      // Rows do not cross multiples of 64.
      for (std::int64_t x = tile.box.lower[0]; x < tile.box.upper[0]; x = (x / 64 + 1) * 64)
      {
        const auto              in = itk::MedialVoxelBits::RangeMask(x >> 6, x, tile.box.upper[0]) >> (x & 63);
        itk::MedialVoxelCellRow row;
        row.first = { { x, y, z } };
        row.candidates = in;
        for (WordType rest = random() & in; rest != 0; rest &= rest - 1)
        {
          tile.object.Set({ { x + itk::MedialVoxelLowestBit(rest), y, z } });
        }
        row.byBound = random() & random() & in;
        row.byGeodesic = random() & random() & in & ~row.byBound;
        row.measured = (row.byBound | row.byGeodesic) & random();
        tile.rows.push_back(row);
        for (int i = 0; i < itk::MedialVoxelPopulationCount(row.measured); ++i)
        {
          itk::MedialVoxelWall wall;
          wall.thickness = static_cast<float>(random() % 1000) / 16.0F;
          wall.isUnpaired = random() % 4 == 0;
          wall.isUnresolved = random() % 8 == 0;
          tile.walls.push_back(wall);
        }
      }
    }
  }
  return tile;
}

/** Cell by cell. */
void
AddCells(const RandomTile & tile, SheetPoints & points)
{
  auto wall = tile.walls.begin();
  for (const itk::MedialVoxelCellRow & row : tile.rows)
  {
    for (int bit = 0; bit < 64; ++bit)
    {
      if (((row.byBound | row.byGeodesic) >> bit & 1) == 0)
      {
        continue;
      }
      const itk::MedialVoxelIndex cell{ { row.first[0] + bit, row.first[1], row.first[2] } };
      SheetPoints::Sums           sums;
      sums.cells = 1;
      std::copy(cell.begin(), cell.end(), sums.index.begin());
      if ((row.measured >> bit & 1) != 0)
      {
        const bool isMeasured = !wall->isUnpaired && !wall->isUnresolved;
        sums.thickness = isMeasured ? static_cast<std::uint64_t>(std::llround(wall->thickness / LengthUnit)) : 0;
        sums.measured = isMeasured ? 1 : 0;
        sums.unpaired = isMeasured ? 0 : 1;
        ++wall;
      }
      points.Add(cell, sums);
    }
  }
}

/** Voxel by voxel of those that are looked at: every \a step along each axis, 4 x 4 x 4 of a block or fewer. */
void
CountVoxels(const RandomTile & tile, std::int64_t edge, std::map<itk::MedialVoxelIndex, std::uint64_t> & counts)
{
  const std::int64_t    step = std::max<std::int64_t>(edge / 4, 1);
  itk::MedialVoxelIndex at;
  for (at[2] = tile.box.lower[2]; at[2] < tile.box.upper[2]; ++at[2])
  {
    for (at[1] = tile.box.lower[1]; at[1] < tile.box.upper[1]; ++at[1])
    {
      for (at[0] = tile.box.lower[0]; at[0] < tile.box.upper[0]; ++at[0])
      {
        if (at[0] % step == 0 && at[1] % step == 0 && at[2] % step == 0 && tile.object.Test(at))
        {
          ++counts[{ { at[2] / edge, at[1] / edge, at[0] / edge } }];
        }
      }
    }
  }
}

/** The arguments of an observer beside the rows. */
class Shower
{
public:
  void
  Show(const RandomTile & tile, SheetSurvey & survey)
  {
    const itk::MedialVoxelWindow window{ &tile.object, nullptr };
    survey.Observe({ tile.box,
                     window,
                     m_Features,
                     m_Classifier,
                     tile.rows,
                     tile.walls,
                     m_Classification,
                     m_Progress,
                     m_Gray,
                     m_Fits },
                   nullptr);
  }

private:
  itk::MedialVoxelFeatures                 m_Features;
  itk::MedialVoxelClassifier               m_Classifier{ { { { 8, 8, 8 } }, { { 1.0, 1.0, 1.0 } } }, {} };
  itk::MedialVoxelClassifier::Workspace    m_Classification;
  itk::MedialVoxelNoProgress               m_Progress;
  itk::MedialVoxelGray                     m_Gray;
  itk::MedialVoxelGrayThickness::Workspace m_Fits;
};

template <typename TCells>
std::string
Save(const TCells & cells)
{
  NumberWriter numbers;
  cells.Save(numbers);
  return numbers.Pack();
}

} // namespace

TEST(SheetSurvey, SumsCellsByBlocksInAnyNumberOfRuns)
{
  std::mt19937_64 random(17);
  Shower          shower;
  // Long axes have blocks of 1, 2, 4, 8, 16 and 128 voxels.
  for (const unsigned int level : { 0u, 1u, 2u, 3u, 4u, 7u })
  {
    VolumeGeometry geometry;
    geometry.size = { level == 0 ? 200u : std::uint64_t{ 1 } << (20 + level), 200, 200 };
    geometry.spacing.assign(3, 1.0);
    SheetSurvey survey(geometry, LengthUnit);
    SheetPoints expected(geometry.size);
    for (unsigned int run = 0; run < 3; ++run)
    {
      survey.Begin();
      for (unsigned int i = 0; i < 5; ++i)
      {
        const RandomTile tile = DrawTile(random, 0);
        shower.Show(tile, survey);
        AddCells(tile, expected);
      }
      survey.Commit();
    }
    EXPECT_EQ(survey.GetPoints().GetLevel(), expected.GetLevel());
    EXPECT_EQ(Save(survey.GetPoints()), Save(expected));
  }
}

TEST(SheetSurvey, CountsObjectVoxelsByBlocksInAnyNumberOfProcesses)
{
  std::mt19937_64 random(18);
  Shower          shower;
  for (const std::int64_t edge : { 1, 2, 4, 8, 16 })
  {
    VolumeGeometry geometry;
    geometry.size = { 100 * static_cast<std::uint64_t>(edge), 100, 64 };
    geometry.spacing.assign(3, 1.0);
    SheetSurvey                                    all(geometry, LengthUnit);
    SheetSurvey                                    merged(geometry, LengthUnit);
    std::map<itk::MedialVoxelIndex, std::uint64_t> expected;
    for (std::int64_t z = 0; z <= 63 / edge; ++z)
    {
      for (std::int64_t y = 0; y <= 99 / edge; ++y)
      {
        for (std::int64_t x = 0; x < 100; ++x)
        {
          expected[{ { z, y, x } }] = 0;
        }
      }
    }
    for (unsigned int run = 0; run < 3; ++run)
    {
      SheetSurvey part(geometry, LengthUnit);
      for (SheetSurvey * const survey : { &all, &part })
      {
        survey->Begin();
      }
      for (unsigned int i = 0; i < 5; ++i)
      {
        const RandomTile tile = DrawTile(random, 0);
        shower.Show(tile, all);
        shower.Show(tile, part);
        CountVoxels(tile, edge, expected);
      }
      for (SheetSurvey * const survey : { &all, &part })
      {
        survey->Commit();
      }
      merged.Merge(part.Save());
    }
    NumberWriter numbers;
    for (const auto & [block, count] : expected)
    {
      numbers.Add(std::min<std::uint64_t>(count, edge < 4 ? edge * edge * edge : 64)); // tiles of objects overlap
    }
    EXPECT_EQ(Save(all.GetPart()), numbers.Pack()) << edge;
    EXPECT_EQ(Save(merged.GetPart()), numbers.Pack()) << edge;
    all.Begin(); // a run that is not committed
    shower.Show(DrawTile(random, 0), all);
    EXPECT_EQ(Save(all.GetPart()), numbers.Pack()) << edge;
    all.Clear();
    EXPECT_EQ(Save(all.GetPart()), Save(PartBlocks(geometry.size)));
  }
}
