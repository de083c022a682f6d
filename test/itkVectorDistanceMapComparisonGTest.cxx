// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The vector distance filter against ITK's own distance maps (invariant I3).

#include "MedialVoxelTestMaurer.h"

#include "itkDanielssonDistanceMapImageFilter.h"

namespace
{
using namespace MedialVoxelTest;

std::vector<Volume>
Volumes()
{
  const Vector3 cranium{ { 0.9570312, 0.9570312, 1.5 } };
  return { RandomBoxes({ { 40, 37, 31 } }, UnitSpacing, 20, 121),
           RandomBoxes({ { 40, 37, 31 } }, cranium, 20, 122),
           RandomVolume({ { 30, 31, 32 } }, { { 0.7, 1.1, 1.3 } }, 0.97, 123),
           RandomVolume({ { 30, 31, 32 } }, UnitSpacing, 0.02, 124),
           Ball({ { 48, 48, 40 } }, cranium, { { 24, 24, 20 } }, 18.0),
           TiltedPlate({ { 40, 40, 40 } }, { { 20, 20, 20 } }, { { 1, 2, 5 } }, 4.0) };
}
} // namespace

TEST(VectorDistanceMapComparison, ObjectBorderIsSignedMaurer)
{
  for (const Volume & volume : Volumes())
  {
    ExpectObjectBorderIsMaurer<3>(volume);
  }
  ExpectObjectBorderIsMaurer<2>(RandomBoxes({ { 90, 70, 1 } }, { { 0.6, 1.0, 1.0 } }, 20, 125));
}

TEST(VectorDistanceMapComparison, BackgroundBorderIsSignedMaurerOfTheComplement)
{
  for (const Volume & volume : Volumes())
  {
    ExpectBackgroundBorderIsMaurerOfTheComplement<3>(volume);
  }
  ExpectBackgroundBorderIsMaurerOfTheComplement<2>(RandomBoxes({ { 90, 70, 1 } }, { { 0.6, 1.0, 1.0 } }, 20, 125));
}

TEST(VectorDistanceMapComparison, SignedDistancesHaveTheFlagsOfSignedMaurer)
{
  const Volume volume = Volumes()[1];
  for (const bool insideIsPositive : { false, true })
  {
    for (const bool squared : { false, true })
    {
      for (const bool useSpacing : { false, true })
      {
        auto filter = VectorFilter<3>::New();
        filter->SetInput(MakeImage<MaskImage<3>>(volume));
        filter->GenerateDistanceOn();
        filter->SetInsideIsPositive(insideIsPositive);
        filter->SetSquaredDistance(squared);
        filter->SetUseImageSpacing(useSpacing);
        filter->Update();
        const auto distances = PixelsOf(filter->GetDistanceOutput());
        const auto expected = MaurerDistances<3>(volume, insideIsPositive, squared, useSpacing);
        for (std::size_t i = 0; i < distances.size(); ++i)
        {
          ASSERT_NEAR(distances[i], expected[i], MaurerTolerance * std::abs(expected[i])) << i;
        }
      }
    }
  }
}

TEST(VectorDistanceMapComparison, MedialVectorsAreSignedMaurerInside)
{
  for (const Volume & volume : Volumes())
  {
    auto filter = MakeMedialFilter<3>(volume, 3.0);
    filter->GenerateVectorDistanceOn();
    filter->Update();
    auto distances = MaurerDistances<3>(volume);
    for (std::size_t i = 0; i < distances.size(); ++i)
    {
      distances[i] = volume.object[i] ? distances[i] : 0.0;
    }
    EXPECT_LT(LargestRelativeDifference(PixelsOf(filter->GetVectorDistanceOutput()), distances), MaurerTolerance);
  }
}

TEST(VectorDistanceMapComparison, DanielssonErrsWhereOursIsBruteForce)
{
  // Three sites. The pixel (4, 1) touches (3, 0) by a corner, at sqrt2; Danielsson's scans hand it (2, 1), at 2.
  Volume points({ { 6, 6, 1 } }, UnitSpacing);
  points.Set({ { 3, 0, 0 } }, true);
  points.Set({ { 2, 1, 0 } }, true);
  points.Set({ { 2, 3, 0 } }, true);
  const std::size_t pixel = points.Offset({ { 4, 1, 0 } });

  auto danielsson = itk::DanielssonDistanceMapImageFilter<MaskImage<2>, itk::Image<double, 2>>::New();
  danielsson->SetInput(MakeImage<MaskImage<2>>(points));
  danielsson->Update();
  EXPECT_DOUBLE_EQ(PixelsOf(danielsson->GetOutput())[pixel], 2.0); // resulting value

  auto filter = VectorFilter<2>::New();
  filter->SetInput(MakeImage<MaskImage<2>>(points));
  filter->Update();
  const auto ours = PixelsOf(filter->GetOutput());
  EXPECT_EQ(ours[pixel][0], -1.0f);
  EXPECT_EQ(ours[pixel][1], -1.0f);
  const std::vector<unsigned char> everywhere(points.object.size(), 1);
  EXPECT_TRUE(
    VectorsAreEqual(ours, ExpectedVectors<2>(points, BoundarySites(points, BoundarySide::Object), everywhere)));
}
