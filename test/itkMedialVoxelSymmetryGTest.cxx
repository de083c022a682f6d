// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Mirrored and axis-permuted inputs (invariant I9).

#include "MedialVoxelTestRuns.h"

#include <numeric>

namespace
{
using namespace MedialVoxelTest;

using DoubleVectors = itk::Image<itk::Vector<double, 3>, 3>;

const Vector3 SkewSpacing{ { 0.7, 1.1, 1.3 } };

/** Squared distance of every voxel to the boundary, both sides, in double. */
std::vector<double>
SquaredDistances(const Volume & volume, itk::MedialVoxelBoundary boundary)
{
  auto filter = itk::VectorDistanceMapImageFilter<MaskImage<3>, DoubleVectors>::New();
  filter->SetInput(MakeImage<MaskImage<3>>(volume));
  filter->SetBoundary(boundary);
  filter->Update();
  std::vector<double> squares;
  for (const auto & vector : PixelsOf(filter->GetOutput()))
  {
    squares.push_back(vector.GetSquaredNorm());
  }
  return squares;
}

/** Where a voxel of the original lies after mirroring along one axis or after a permutation. */
struct Transform
{
  Volume                                image;
  std::function<Index3(const Index3 &)> voxel;
  std::function<Index3(const Index3 &)> cell;
};

Transform
MirrorAlong(const Volume & volume, int axis)
{
  const int  last = volume.size[axis] - 1;
  const auto mirror = [axis](const Index3 & v, int sum) {
    Index3 m = v;
    m[axis] = sum - v[axis];
    return m;
  };
  return { Mirrored(volume, axis),
           [=](const Index3 & v) { return mirror(v, last); },
           [=](const Index3 & v) { return mirror(v, last - (last > 0 ? 1 : 0)); } };
}

Transform
PermuteAxes(const Volume & volume, const Index3 & order)
{
  const auto permute = [order](const Index3 & v) { return Index3{ { v[order[0]], v[order[1]], v[order[2]] } }; };
  return { Permuted(volume, order), permute, permute };
}

std::vector<Transform>
AllTransforms(const Volume & volume)
{
  std::vector<Transform> transforms;
  for (int axis = 0; axis < 3; ++axis)
  {
    transforms.push_back(MirrorAlong(volume, axis));
  }
  for (const Index3 & order : { Index3{ { 1, 0, 2 } },
                                Index3{ { 2, 1, 0 } },
                                Index3{ { 0, 2, 1 } },
                                Index3{ { 1, 2, 0 } },
                                Index3{ { 2, 0, 1 } } })
  {
    transforms.push_back(PermuteAxes(volume, order));
  }
  return transforms;
}

/** Compares labels on the tie-free cells and tells how many there were. */
std::size_t
ExpectLabelsMap(const Volume & volume, double thickness)
{
  const auto tieFree = Classifier(volume, thickness).TieFreeCells();
  const auto labels = RunMedialFilter<3>(volume, thickness).labels;
  for (const Transform & transform : AllTransforms(volume))
  {
    const auto  mapped = RunMedialFilter<3>(transform.image, thickness).labels;
    std::size_t differences = 0;
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      const Index3 cell = volume.IndexAt(i);
      differences += tieFree[i] && mapped[transform.image.Offset(transform.cell(cell))] != labels[i] ? 1 : 0;
    }
    EXPECT_EQ(differences, 0u);
  }
  return std::accumulate(tieFree.begin(), tieFree.end(), std::size_t{ 0 });
}
} // namespace

TEST(MedialVoxelSymmetry, SquaredDistancesMapExactlyForEqualSpacing)
{
  const Volume volume = RandomBoxes({ { 21, 18, 16 } }, UnitSpacing, 12, 61);
  for (const auto boundary : { itk::MedialVoxelBoundary::Object, itk::MedialVoxelBoundary::Background })
  {
    const auto squares = SquaredDistances(volume, boundary);
    for (const Transform & transform : AllTransforms(volume))
    {
      const auto          mapped = SquaredDistances(transform.image, boundary);
      std::vector<double> pulledBack;
      for (std::size_t i = 0; i < squares.size(); ++i)
      {
        pulledBack.push_back(mapped[transform.image.Offset(transform.voxel(volume.IndexAt(i)))]);
      }
      EXPECT_TRUE(AreEqual(pulledBack, squares));
    }
  }
}

TEST(MedialVoxelSymmetry, SquaredDistancesMapToRoundingForUnequalSpacing)
{
  const Volume volume = RandomBoxes({ { 21, 18, 16 } }, SkewSpacing, 12, 62);
  const auto   squares = SquaredDistances(volume, itk::MedialVoxelBoundary::Background);
  for (const Transform & transform : AllTransforms(volume))
  {
    const auto mapped = SquaredDistances(transform.image, itk::MedialVoxelBoundary::Background);
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
      const double image = mapped[transform.image.Offset(transform.voxel(volume.IndexAt(i)))];
      ASSERT_NEAR(image, squares[i], 1e-12 * squares[i]) << i;
    }
  }
}

TEST(MedialVoxelSymmetry, LabelsMapOnCellsWithoutTies)
{
  EXPECT_GT(ExpectLabelsMap(RandomVolume({ { 12, 11, 10 } }, SkewSpacing, 0.8, 63), 2.0), 30u);
  EXPECT_GT(ExpectLabelsMap(RandomBoxes({ { 14, 13, 12 } }, SkewSpacing, 9, 64), 3.0), 30u);
  EXPECT_GT(ExpectLabelsMap(RandomVolume({ { 12, 11, 10 } }, UnitSpacing, 0.9, 66), 2.0), 30u);
}

TEST(MedialVoxelSymmetry, LabelsMapEverywhereWithoutAnyTie)
{
  // A skewed slab in which every voxel has one nearest point and every cell one best pair.
  const Volume slab = MakeVolume({ { 3, 3, 3 } }, SkewSpacing, [](const Index3 & v) {
    const int level = v[0] - v[1] + 3 * v[2] - 2;
    return level >= 0 && level < 6;
  });
  for (const double thickness : { 0.9, 1.2, 1.6, 2.0 })
  {
    EXPECT_EQ(ExpectLabelsMap(slab, thickness), 8u);
  }
  // A staircase two pixels wide, in one slice.
  const Volume stairs =
    MakeVolume({ { 8, 8, 1 } }, SkewSpacing, [](const Index3 & v) { return v[0] == v[1] || v[0] == v[1] + 1; });
  const auto candidates = Classify(stairs, 0.9, Bound::Off).counts.candidateCells;
  for (const double thickness : { 0.9, 1.2, 1.6, 2.0 })
  {
    EXPECT_EQ(ExpectLabelsMap(stairs, thickness), candidates);
  }
}
