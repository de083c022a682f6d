// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Figures 2, 4, 5 and 6 of the paper as tiny cases, checked by hand.

#include "MedialVoxelTestRuns.h"

namespace
{
using namespace MedialVoxelTest;

/** A plane image from rows of text, '#' for object; the first row is y = 0. */
Volume
Drawing(const std::vector<std::string> & rows)
{
  return MakeVolume({ { static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), 1 } },
                    UnitSpacing,
                    [&rows](const Index3 & v) { return rows[v[1]][v[0]] == '#'; });
}

/** The label image as rows of digits. */
std::vector<std::string>
LabelRows(const Volume & volume, double thickness, Bound bound = Bound::FreeSpace)
{
  const auto               labels = RunMedialFilter<2>(volume, thickness, bound).labels;
  std::vector<std::string> rows(volume.size[1]);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    rows[volume.IndexAt(i)[1]] += static_cast<char>('0' + labels[i]);
  }
  return rows;
}
} // namespace

TEST(MedialVoxelPaperFigures, Figure2GeodesicsTellSidesApart)
{
  // A strip of two rows with a free end. Between its rows the cell at x sees (x, 1) and (x + 1, 4), which are joined
  // only around the end. For x = 4 that is (4,1) (5,1) (6,2) (6,3) (5,4), of length 2 + 2 sqrt2 = 4.83, and 2 longer
  // for each cell further from the end. Epsilon is 4.71 for tau 3 and 5.03 for tau 3.2.
  const Volume strip = Drawing({ "........", "........", "######..", "######..", "........", "........" });
  const std::vector<std::string> thin{ "00000000", "11111100", "33333100", "11111100", "00000000", "00000000" };
  EXPECT_EQ(LabelRows(strip, 3.0), thin);
  const std::vector<std::string> thick{ "00000000", "11111100", "33331100", "11111100", "00000000", "00000000" };
  EXPECT_EQ(LabelRows(strip, 3.2), thick);
}

TEST(MedialVoxelPaperFigures, Figure4DualCellsLieBetweenTheVoxels)
{
  // One pixel: its four cells are stored at their lowest corners, half a pixel further on.
  const Volume                   pixel = Drawing({ "...", ".#.", "..." });
  const std::vector<std::string> cells{ "110", "110", "000" };
  EXPECT_EQ(LabelRows(pixel, 3.0), cells);
  auto filter = MakeMedialFilter<2>(pixel, 3.0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetOrigin()[0], 0.5);
  EXPECT_EQ(filter->GetOutput()->GetOrigin()[1], 0.5);
  EXPECT_EQ(filter->GetCounts().trivialCells, 4u);
  // Each pair is the diagonal of background corners, an edge of sqrt2 = 1.41; epsilon is 1.26 for tau 0.8.
  const std::vector<std::string> medial{ "220", "220", "000" };
  EXPECT_EQ(LabelRows(pixel, 0.8), medial);
}

TEST(MedialVoxelPaperFigures, Figure5NeighboringPointsAreNotMedial)
{
  // Below a flat face the corners of a cell see 26-neighbors: (x, y, 3) and (x + 1, y + 1, 3).
  const Volume face = MakeVolume({ { 4, 4, 9 } }, UnitSpacing, [](const Index3 & v) { return v[2] >= 4; });
  const auto   run = RunMedialFilter<3>(face, 0.5);
  // Epsilon 0.79 is shorter than the edge between them, so that nothing is trivial and all is medial.
  EXPECT_EQ(run.counts.trivialCells, 0u);
  EXPECT_EQ(run.counts.boundCells, 3u * 3u * 5u);
  const auto usual = RunMedialFilter<3>(face, 3.0);
  EXPECT_EQ(usual.counts.trivialCells, 3u * 3u * 5u);
  EXPECT_EQ(usual.counts.boundCells + usual.counts.geodesicMedialCells, 0u);
}

TEST(MedialVoxelPaperFigures, Figure6PseudoGeodesicDistanceIsRadiusTimesAngle)
{
  // A wall of 4 voxels: on its mid-plane both distances are 2 and the angle is pi, so that d theta = 2 pi.
  // It reaches epsilon = pi tau / 2 for tau <= 4.
  const Volume wall = AxisPlate({ { 4, 4, 10 } }, UnitSpacing, 2, 3, 4);
  for (const double thickness : { 2.0, 3.9, 4.0 })
  {
    EXPECT_EQ(RunMedialFilter<3>(wall, thickness, Bound::Paper).counts.boundCells, 9u) << thickness;
  }
  EXPECT_EQ(RunMedialFilter<3>(wall, std::nextafter(4.0, 5.0), Bound::Paper).counts.boundCells, 0u);
  EXPECT_EQ(RunMedialFilter<3>(wall, std::nextafter(4.0, 5.0), Bound::Paper).counts.geodesicMedialCells, 9u);
  // In a wall of 3 voxels the norms are 1 and 2: the smaller one counts, and d theta = pi reaches epsilon for tau <= 2.
  const Volume odd = AxisPlate({ { 4, 4, 10 } }, UnitSpacing, 2, 3, 3);
  EXPECT_EQ(RunMedialFilter<3>(odd, 2.0, Bound::Paper).counts.boundCells, 9u);
  EXPECT_EQ(RunMedialFilter<3>(odd, std::nextafter(2.0, 3.0), Bound::Paper).counts.boundCells, 0u);
}

TEST(MedialVoxelPaperFigures, Figure6NeedsTwoVectors)
{
  // One layer: a corner of each of its cells is boundary itself, its vector is zero, and Eq. 2 decides nothing.
  const Volume layer = AxisPlate({ { 4, 4, 7 } }, UnitSpacing, 2, 3, 1);
  const auto   paper = RunMedialFilter<3>(layer, 0.1, Bound::Paper);
  EXPECT_EQ(paper.counts.boundCells, 0u);
  EXPECT_GT(paper.counts.geodesicMedialCells, 0u);
}
