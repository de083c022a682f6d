// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Labels, vectors and counts against brute force (invariants I1, I4, I5, I6).

#include "MedialVoxelTestRuns.h"

namespace
{
using namespace MedialVoxelTest;

struct Case
{
  std::string name;
  Volume      volume;
};

const Vector3 CraniumSpacing{ { 0.9570312, 0.9570312, 1.5 } };
const Vector3 SkewSpacing{ { 0.7, 1.1, 1.3 } };
const Vector3 WideSpacing{ { 2.0, 0.5, 1.0 } };

std::vector<Case>
RandomCases(const Index3 & size)
{
  std::vector<Case> cases;
  unsigned int      seed = 100;
  for (const double density : { 0.05, 0.3, 0.6, 0.85, 0.97 })
  {
    for (const Vector3 & spacing : { UnitSpacing, CraniumSpacing, SkewSpacing })
    {
      cases.push_back({ "density " + std::to_string(density) + " seed " + std::to_string(seed),
                        RandomVolume(size, spacing, density, seed) });
      ++seed;
    }
  }
  return cases;
}

std::vector<Case>
ShapedCases()
{
  const Index3 size{ { 13, 11, 12 } };
  return { { "boxes", RandomBoxes(size, UnitSpacing, 9, 1) },
           { "boxes, equal spacing 0.5", RandomBoxes(size, { { 0.5, 0.5, 0.5 } }, 9, 2) },
           { "boxes, wide spacing", RandomBoxes(size, WideSpacing, 9, 3) },
           { "boxes, cranium spacing", RandomBoxes(size, CraniumSpacing, 9, 4) },
           { "lattice of holes", LatticeOfHoles(size, UnitSpacing, 4) },
           { "lattice of holes, cranium spacing", LatticeOfHoles(size, CraniumSpacing, 3) },
           { "ball", Ball(size, UnitSpacing, { { 6, 5, 6 } }, 4.6) },
           { "ball, skew spacing", Ball(size, SkewSpacing, { { 6, 5, 6 } }, 4.2) },
           { "tilted plate", TiltedPlate(size, { { 6, 5, 6 } }, { { 1, 2, 5 } }, 3.2) },
           { "shell", SphericalShell(size, { { 6, 5, 6 } }, 3.6, 2.0) },
           { "tee", TeeJunction(size, 2, 3) },
           { "ell", EllJunction(size, 3, 4) } };
}

std::vector<Case>
PlaneCases()
{
  const Index3 size{ { 23, 19, 1 } };
  return { { "sparse", RandomVolume(size, { { 1.0, 1.0, 4.0 } }, 0.2, 11) },
           { "dense", RandomVolume(size, { { 0.8, 0.8, 3.0 } }, 0.8, 12) },
           { "anisotropic", RandomVolume(size, { { 0.6, 1.0, 1.0 } }, 0.9, 13) },
           { "boxes", RandomBoxes(size, UnitSpacing, 7, 14) },
           { "boxes, anisotropic", RandomBoxes(size, { { 1.0, 1.7, 1.0 } }, 7, 15) },
           { "ring", SphericalShell(size, { { 11, 9, 0 } }, 6.0, 3.0) } };
}

template <unsigned int D>
void
ExpectOracleLabels(const Case & testCase, double thickness)
{
  Classifier oracle(testCase.volume, thickness);
  for (const Bound bound : { Bound::FreeSpace, Bound::Paper, Bound::Off })
  {
    SCOPED_TRACE(testCase.name + ", thickness " + std::to_string(thickness) + ", bound " +
                 std::to_string(static_cast<int>(bound)));
    const auto expected = oracle.Run(bound);
    const auto actual = RunMedialFilter<D>(testCase.volume, thickness, bound);
    EXPECT_TRUE(AreEqual(actual.labels, expected.labels));
    EXPECT_EQ(actual.counts, expected.counts);
  }
}

template <unsigned int D>
void
ExpectOracleVectors(const Case & testCase, BoundarySide side)
{
  SCOPED_TRACE(testCase.name);
  auto filter = MakeMedialFilter<D>(testCase.volume, 3.0);
  filter->GenerateVectorDistanceOn();
  filter->SetVectorDistanceBoundary(side == BoundarySide::Object ? itk::MedialVoxelBoundary::Object
                                                                 : itk::MedialVoxelBoundary::Background);
  filter->UpdateLargestPossibleRegion();
  const auto sites = BoundarySites(testCase.volume, side);
  EXPECT_TRUE(VectorsAreEqual(PixelsOf(filter->GetVectorDistanceOutput()),
                              ExpectedVectors<D>(testCase.volume, sites, testCase.volume.object)));
}
} // namespace

TEST(MedialVoxelOracle, LabelsOfRandomVolumesAreThoseOfDijkstra)
{
  for (const Case & testCase : RandomCases({ { 9, 8, 10 } }))
  {
    for (const double thickness : { 2.0, 3.0, 5.0, 8.0 })
    {
      ExpectOracleLabels<3>(testCase, thickness);
    }
  }
}

TEST(MedialVoxelOracle, LabelsOfShapesAreThoseOfDijkstra)
{
  for (const Case & testCase : ShapedCases())
  {
    for (const double thickness : { 2.0, 3.0, 5.0, 8.0 })
    {
      ExpectOracleLabels<3>(testCase, thickness);
    }
  }
}

TEST(MedialVoxelOracle, LabelsOfPlaneImagesAreThoseOfDijkstra)
{
  for (const Case & testCase : PlaneCases())
  {
    for (const double thickness : { 0.5, 2.0, 3.0, 5.0, 8.0 })
    {
      ExpectOracleLabels<2>(testCase, thickness);
    }
  }
}

TEST(MedialVoxelOracle, PinnedFixturesAreThoseOfDijkstra)
{
  ExpectOracleLabels<2>({ "plane", Fixture("plane") }, 3.0);
  ExpectOracleLabels<3>({ "isotropic", Fixture("isotropic") }, 3.0);
  ExpectOracleLabels<3>({ "anisotropic", Fixture("anisotropic") }, 3.0);
}

TEST(MedialVoxelOracle, VoxelUnitsIgnoreTheSpacing)
{
  const Volume volume = RandomBoxes({ { 12, 11, 10 } }, CraniumSpacing, 8, 21);
  auto         filter = MakeMedialFilter<3>(volume, 3.0);
  filter->UseImageSpacingOff();
  filter->GenerateVectorDistanceOn();
  filter->UpdateLargestPossibleRegion();
  const Volume plain = InVoxelUnits(volume);
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), Classify(plain, 3.0, Bound::FreeSpace).labels));
  const auto sites = BoundarySites(plain, BoundarySide::Object);
  EXPECT_TRUE(
    VectorsAreEqual(PixelsOf(filter->GetVectorDistanceOutput()), ExpectedVectors<3>(plain, sites, plain.object)));
}

TEST(MedialVoxelOracle, VectorsPointToTheNearestBoundaryWithTheSmallestKey)
{
  for (const BoundarySide side : { BoundarySide::Object, BoundarySide::Background })
  {
    for (const Case & testCase : RandomCases({ { 17, 15, 14 } }))
    {
      ExpectOracleVectors<3>(testCase, side);
    }
    for (const Case & testCase : ShapedCases())
    {
      ExpectOracleVectors<3>(testCase, side);
    }
    for (const Case & testCase : PlaneCases())
    {
      ExpectOracleVectors<2>(testCase, side);
    }
  }
}

TEST(MedialVoxelOracle, ThickSolidsPointToTheNearestBoundary)
{
  const Case cases[] = {
    { "solid with one hole",
      MakeVolume({ { 24, 22, 23 } }, UnitSpacing, [](const Index3 & v) { return v != Index3{ { 3, 4, 20 } }; }) },
    { "ball", Ball({ { 24, 24, 24 } }, UnitSpacing, { { 11.5, 11.5, 11.5 } }, 11.0) },
    { "ball, cranium spacing", Ball({ { 24, 24, 20 } }, CraniumSpacing, { { 11.5, 12, 10 } }, 9.3) },
    { "half space", AxisPlate({ { 24, 9, 11 } }, SkewSpacing, 0, 2, 22) }
  };
  for (const Case & testCase : cases)
  {
    ExpectOracleVectors<3>(testCase, BoundarySide::Object);
    ExpectOracleVectors<3>(testCase, BoundarySide::Background);
  }
}

TEST(MedialVoxelOracle, WideRowsCrossWordBorders)
{
  const Case cases[] = { { "wide boxes", RandomBoxes({ { 150, 6, 5 } }, UnitSpacing, 30, 31) },
                         { "wide noise", RandomVolume({ { 130, 5, 5 } }, UnitSpacing, 0.9, 32) },
                         { "wide noise, skew", RandomVolume({ { 131, 5, 4 } }, SkewSpacing, 0.93, 33) } };
  for (const Case & testCase : cases)
  {
    ExpectOracleLabels<3>(testCase, 3.0);
    ExpectOracleVectors<3>(testCase, BoundarySide::Background);
  }
}

TEST(MedialVoxelOracle, PathsAsLongAsEpsilonAreMedial)
{
  // Whole path lengths i + j sqrt(2) + k sqrt(3) as epsilon, and its neighbors among the doubles.
  const Volume volume = RandomBoxes({ { 6, 6, 5 } }, UnitSpacing, 5, 41);
  int          tried = 0;
  for (const double epsilon : { 1.0,
                                std::sqrt(2.0),
                                std::sqrt(3.0),
                                2.0,
                                1.0 + std::sqrt(2.0),
                                1.0 + std::sqrt(3.0),
                                2.0 * std::sqrt(2.0),
                                3.0,
                                1.0 + 2.0 * std::sqrt(2.0),
                                2.0 + std::sqrt(2.0) })
  {
    const double thickness = ThicknessForEpsilon(epsilon);
    if (thickness == 0.0)
    {
      continue;
    }
    ++tried;
    for (const double value : { thickness, std::nextafter(thickness, 0.0), std::nextafter(thickness, 9.0) })
    {
      for (const Bound bound : { Bound::FreeSpace, Bound::Off })
      {
        SCOPED_TRACE("epsilon " + std::to_string(epsilon));
        const auto expected = Classify(volume, value, bound, PathSums::Exact);
        EXPECT_TRUE(AreEqual(RunMedialFilter<3>(volume, value, bound).labels, expected.labels));
      }
    }
  }
  EXPECT_GE(tried, 5);
}

TEST(MedialVoxelOracle, BoundsDoNotChangeWhichCellsAreMedial)
{
  const Volume volume = RandomBoxes({ { 40, 36, 30 } }, UnitSpacing, 40, 51);
  for (const double thickness : { 2.0, 3.0, 5.0 })
  {
    const auto bounded = RunMedialFilter<3>(volume, thickness, Bound::FreeSpace);
    const auto plain = RunMedialFilter<3>(volume, thickness, Bound::Off);
    EXPECT_GT(bounded.counts.boundCells, 0u);
    EXPECT_EQ(plain.counts.boundCells, 0u);
    for (std::size_t i = 0; i < plain.labels.size(); ++i)
    {
      ASSERT_EQ(bounded.labels[i] >= 2, plain.labels[i] >= 2) << i;
    }
  }
}

TEST(MedialVoxelOracle, CountsAddUpAndAreTheHistogram)
{
  const Volume volume = RandomBoxes({ { 40, 36, 30 } }, CraniumSpacing, 40, 52);
  for (const Bound bound : { Bound::FreeSpace, Bound::Paper, Bound::Off })
  {
    const auto   run = RunMedialFilter<3>(volume, 3.0, bound);
    const auto & c = run.counts;
    const auto   labelled = [&run](unsigned char label) {
      return static_cast<std::uint64_t>(std::count(run.labels.begin(), run.labels.end(), label));
    };
    EXPECT_EQ(c.trivialCells + c.boundCells + c.geodesicMedialCells + c.geodesicNonMedialCells, c.candidateCells);
    EXPECT_EQ(labelled(1), c.trivialCells + c.geodesicNonMedialCells);
    EXPECT_EQ(labelled(2), c.boundCells);
    EXPECT_EQ(labelled(3), c.geodesicMedialCells);
    EXPECT_EQ(labelled(0), volume.object.size() - c.candidateCells);
  }
}

TEST(MedialVoxelOracle, LargerThicknessNeverAddsMedialCells)
{
  for (const Vector3 & spacing : { UnitSpacing, SkewSpacing })
  {
    const Volume volume = RandomBoxes({ { 30, 28, 26 } }, spacing, 30, 53);
    auto         previous = RunMedialFilter<3>(volume, 0.4).labels;
    for (const double thickness : { 0.7, 1.0, 1.4, 2.0, 2.7, 3.5, 5.0, 7.0, 10.0 })
    {
      const auto labels = RunMedialFilter<3>(volume, thickness).labels;
      for (std::size_t i = 0; i < labels.size(); ++i)
      {
        ASSERT_TRUE(labels[i] < 2 || previous[i] >= 2) << "thickness " << thickness << ", cell " << i;
      }
      previous = labels;
    }
  }
}
