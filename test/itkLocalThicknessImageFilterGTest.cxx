// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Local thickness against brute force, and the options, errors and divisions of its filter.

#include "MedialVoxelTestLocalThickness.h"
#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkStreamingImageFilter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

template class itk::LocalThicknessImageFilter<itk::Image<unsigned char, 2>>;
template class itk::LocalThicknessImageFilter<itk::Image<short, 3>>;

namespace
{
using namespace MedialVoxelTest;

using Method = itk::MedialVoxelLocalThicknessMethod;

template <unsigned int VDimension>
typename ThicknessFilter<VDimension>::Pointer
MakeFilter(const Volume & volume, const double maximumThickness)
{
  auto filter = ThicknessFilter<VDimension>::New();
  filter->SetInput(MakeImage<MaskImage<VDimension>>(volume));
  filter->SetMethod(Method::Sphere);
  filter->SetLargestBall(maximumThickness);
  return filter;
}

const Vector3 Spacings[] = { { { 1, 1, 1 } }, { { 0.7, 0.7, 1.2 } }, { { 1.3, 0.4, 0.9 } } };
} // namespace

TEST(LocalThicknessImageFilter, EqualsBruteForceInEveryVoxel)
{
  unsigned int seed = 500;
  for (const Vector3 & spacing : Spacings)
  {
    for (const double maximum : { 1.5, 5.0, 9.3, 80.0 })
    {
      for (const Index3 & size : { Index3{ { 21, 17, 15 } }, Index3{ { 9, 25, 13 } } })
      {
        const Volume volume = RandomBoxes(size, spacing, 6 + seed % 9, seed);
        auto         filter = MakeFilter<3>(volume, maximum);
        itk::MedialVoxelFilterAccess::SetTileSize(*filter, 4 + seed % 11);
        itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 1 + seed % 7);
        filter->Update();
        const auto expected = ExpectedThickness(volume, maximum);
        EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected)) << maximum << ' ' << seed;
        EXPECT_EQ(filter->GetNumberOfVoxelsAtMaximum(),
                  std::count(expected.begin(), expected.end(), static_cast<float>(maximum)));
        ++seed;
      }
    }
  }
}

TEST(LocalThicknessImageFilter, EqualsBruteForceInNoiseSolidsAndPlanes)
{
  std::mt19937 random(77);
  for (const Vector3 & spacing : Spacings)
  {
    for (const double share : { 0.5, 0.95, 0.999, 1.0 })
    {
      const auto isObject = [&](const Index3 &) { return std::uniform_real_distribution<>(0.0, 1.0)(random) < share; };
      const Volume noise = MakeVolume({ { 13, 12, 14 } }, spacing, isObject);
      const Volume plane = MakeVolume({ { 30, 27, 1 } }, spacing, isObject);
      for (const double maximum : { 4.0, 8.5 })
      {
        auto filter = MakeFilter<3>(noise, maximum);
        itk::MedialVoxelFilterAccess::SetTileSize(*filter, 5);
        filter->Update();
        EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), ExpectedThickness(noise, maximum))) << share;
        auto flat = MakeFilter<2>(plane, maximum);
        flat->Update();
        EXPECT_TRUE(AreEqual(PixelsOf(flat->GetOutput()), ExpectedThickness(plane, maximum))) << share;
      }
    }
  }
}

TEST(LocalThicknessImageFilter, WideTilesEqualBruteForce)
{
  const Volume volume = RandomBoxes({ { 150, 11, 9 } }, UnitSpacing, 25, 9);
  for (const unsigned int tileSize : { 0u, 70u, 200u })
  {
    auto filter = MakeFilter<3>(volume, 6.0);
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, tileSize);
    filter->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), ExpectedThickness(volume, 6.0))) << tileSize;
  }
}

TEST(LocalThicknessImageFilter, AnyDivisionGivesTheSameBytes)
{
  const Volume volume = RandomBoxes({ { 60, 52, 47 } }, { { 0.7, 0.7, 1.2 } }, 30, 12);
  auto         reference = MakeFilter<3>(volume, 12.0);
  reference->Update();
  const auto expected = PixelsOf(reference->GetOutput());
  for (const auto & cut : { std::make_pair(2u, 7u), { 1u, 5u }, { 64u, 64u } })
  {
    auto filter = MakeFilter<3>(volume, 12.0);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, cut.first);
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, cut.second);
    filter->SetNumberOfWorkUnits(3);
    filter->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected)) << cut.first;
  }
  for (const unsigned int divisions : { 5u, 47u })
  {
    auto filter = MakeFilter<3>(volume, 12.0);
    auto streamer = itk::StreamingImageFilter<itk::Image<float, 3>, itk::Image<float, 3>>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), expected)) << divisions;
  }
  auto limited = MakeFilter<3>(volume, 12.0);
  limited->SetNumberOfWorkUnits(1);
  limited->SetWorkingMemoryLimit(itk::SizeValueType{ 4 } << 20);
  limited->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(limited->GetOutput()), expected));
}

TEST(LocalThicknessImageFilter, PlatesReadTheirNumberOfVoxelsOrOneMore)
{
  for (const unsigned int layers : { 1u, 2u, 3u, 4u, 7u, 8u, 16u })
  {
    const Volume volume = MakeVolume({ { 40, 40, 30 } }, UnitSpacing, [&](const Index3 & at) {
      return at[2] >= 6 && at[2] < 6 + static_cast<long>(layers);
    });
    auto         filter = MakeFilter<3>(volume, 32.0);
    filter->Update();
    const auto values = PixelsOf(filter->GetOutput());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      EXPECT_EQ(values[i], volume.object[i] ? static_cast<float>(layers + layers % 2) : 0.0f);
    }
    EXPECT_EQ(filter->GetCounts().objectVoxels, 1600u * layers);
  }
}

TEST(LocalThicknessImageFilter, UnitsAreThoseOfTheSpacingOrVoxels)
{
  Volume volume = RandomBoxes({ { 24, 20, 18 } }, { { 0.25, 0.25, 0.25 } }, 12, 31);
  auto   physical = MakeFilter<3>(volume, 2.0);
  physical->Update();
  auto inVoxels = MakeFilter<3>(volume, 8.0);
  inVoxels->UseImageSpacingOff();
  inVoxels->Update();
  const auto first = PixelsOf(physical->GetOutput());
  const auto second = PixelsOf(inVoxels->GetOutput());
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_EQ(4.0f * first[i], second[i]);
  }
}

TEST(LocalThicknessImageFilter, HasTheDocumentedDefaultsAndRefusesOthers)
{
  auto filter = ThicknessFilter<3>::New();
  EXPECT_STREQ(filter->GetNameOfClass(), "LocalThicknessImageFilter");
  EXPECT_EQ(filter->GetLargestBall(), 0.0);
  EXPECT_EQ(filter->GetMethod(), Method::Wall);
  EXPECT_THROW(filter->SetMethod(static_cast<Method>(2)), itk::ExceptionObject);
  for (const double wrong : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    EXPECT_THROW(filter->SetLargestBall(wrong), itk::ExceptionObject) << wrong;
  }
  const Volume volume =
    MakeVolume({ { 80, 80, 80 } }, { { 0.5, 0.5, 0.5 } }, [](const Index3 & at) { return at[0] > 0 || at[1] > 0; });
  filter->SetInput(MakeImage<MaskImage<3>>(volume));
  filter->SetMethod(Method::Sphere);
  filter->Update();
  const auto values = PixelsOf(filter->GetOutput());
  EXPECT_EQ(*std::max_element(values.begin(), values.end()), 16.0f); // 32 voxels
  filter->SetLargestBall(128.5);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->UnsetLargestBall();
  EXPECT_EQ(filter->GetLargestBall(), 0.0);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("LargestBall: 0"), std::string::npos);
}
