// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetSurvey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace medialvoxel;

namespace
{

constexpr double LengthUnit = 0.25;

/** Rows of random medial cells of a tile, some of them measured. */
struct RandomTile
{
  itk::MedialVoxelBox                  box;
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

/** The arguments of an observer beside the rows. */
class Shower
{
public:
  void
  Show(const RandomTile & tile, SheetSurvey & survey)
  {
    survey.Observe({ tile.box,
                     m_Window,
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
  itk::MedialVoxelWindow                   m_Window{ nullptr, nullptr };
  itk::MedialVoxelFeatures                 m_Features;
  itk::MedialVoxelClassifier               m_Classifier{ { { { 8, 8, 8 } }, { { 1.0, 1.0, 1.0 } } }, {} };
  itk::MedialVoxelClassifier::Workspace    m_Classification;
  itk::MedialVoxelNoProgress               m_Progress;
  itk::MedialVoxelGray                     m_Gray;
  itk::MedialVoxelGrayThickness::Workspace m_Fits;
};

std::string
Save(const SheetPoints & points)
{
  NumberWriter numbers;
  points.Save(numbers);
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
