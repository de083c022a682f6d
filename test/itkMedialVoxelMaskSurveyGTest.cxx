// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Values of masks and label maps, and values that are none.

#include "itkMedialVoxelImageFilter.h"
#include "itkMedialVoxelScanSurvey.h"

#include "MedialVoxelTestPhantoms.h"
#include "MedialVoxelTestSupport.h"

#include "gtest/gtest.h"

#include <algorithm>
#include <cstdint>
#include <cmath>
#include <functional>

namespace
{
using Index = itk::MedialVoxelIndex;
using Value = std::function<float(const Index & voxel)>;

/** Blocks of the survey are 256 x 256 x 16: several of them. */
const itk::MedialVoxelGrid Grid({ { 40, 40, 70 } }, { { 1.0, 1.0, 1.0 } });

/** Object are the voxels from the threshold on. */
itk::MedialVoxelScanSurvey::Result
Survey(const Value & value, const float threshold, const bool isReversed)
{
  itk::MedialVoxelScanSurvey::Source source;
  source.fill = [&](const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object, itk::MedialVoxelGray & gray) {
    Index at;
    for (at[2] = box.lower[2]; at[2] < box.upper[2]; ++at[2])
    {
      for (at[1] = box.lower[1]; at[1] < box.upper[1]; ++at[1])
      {
        for (at[0] = box.lower[0]; at[0] < box.upper[0]; ++at[0])
        {
          gray.GetRow(at[1], at[2])[at[0] - box.lower[0]] = value(at);
          if (value(at) >= threshold)
          {
            object.Set(at);
          }
        }
      }
    }
  };
  source.forEach = [isReversed](auto boxes, const auto & work) {
    if (isReversed)
    {
      std::reverse(boxes.begin(), boxes.end());
    }
    std::for_each(boxes.begin(), boxes.end(), work);
  };
  source.observe = [](double) {};
  return itk::MedialVoxelScanSurvey(Grid, threshold, std::nullopt).Run(source);
}

/** Distance from a tilted plane through the middle, in layers of voxels. */
std::int64_t
GetLayer(const Index & voxel)
{
  return std::abs(voxel[0] - 20 + 2 * (voxel[1] - 20) + 5 * (voxel[2] - 35));
}

} // namespace

TEST(MedialVoxelMaskSurvey, TwoValuesAreAMaskWhereverTheThresholdIs)
{
  for (const std::int64_t layers : { 3, 8, 20 })
  {
    const Value mask = [layers](const Index & voxel) { return GetLayer(voxel) <= layers ? 250.0f : 50.0f; };
    for (const float threshold : { 51.0f, 150.0f, 250.0f })
    {
      for (const bool isReversed : { false, true })
      {
        const auto result = Survey(mask, threshold, isReversed);
        EXPECT_FALSE(result.scan);
        EXPECT_TRUE(result.isMask) << layers << ' ' << threshold;
        EXPECT_EQ(result.reason, "the values are those of a mask or a label map");
      }
    }
  }
}

TEST(MedialVoxelMaskSurvey, LabelsOfSeveralObjectsAreALabelMap)
{
  const Value labels = [](const Index & voxel) {
    const bool isObject = GetLayer(voxel) <= 8;
    return isObject ? static_cast<float>(1 + voxel[0] / 8) : 0.0f;
  };
  for (const float threshold : { 0.5f, 1.0f })
  {
    EXPECT_TRUE(Survey(labels, threshold, false).isMask) << threshold;
  }
}

TEST(MedialVoxelMaskSurvey, ValuesThatRiseOverAVoxelAreNoMask)
{
  // Some of the walls lie between voxels whose values do not change behind them.
  const Value scan = [](const Index & voxel) {
    return std::clamp(50.0f + 40.0f * static_cast<float>(10 - GetLayer(voxel)), 50.0f, 250.0f);
  };
  for (const bool isReversed : { false, true })
  {
    EXPECT_FALSE(Survey(scan, 150.0f, isReversed).isMask);
  }
}

TEST(MedialVoxelMaskSurvey, NoiseMakesItNoMask)
{
  const Value scan = [](const Index & voxel) {
    const auto noise = static_cast<float>((voxel[0] * 7 + voxel[1] * 13 + voxel[2] * 29) % 5);
    return (GetLayer(voxel) <= 8 ? 250.0f : 50.0f) + noise;
  };
  EXPECT_FALSE(Survey(scan, 150.0f, false).isMask);
}

TEST(MedialVoxelMaskSurvey, AFewOtherValuesLeaveItAMask)
{
  const Value almost = [](const Index & voxel) {
    const bool isOther = voxel == Index{ { 20, 20, 35 } } || voxel == Index{ { 20, 20, 39 } };
    return isOther ? 240.0f : (GetLayer(voxel) <= 8 ? 250.0f : 50.0f);
  };
  EXPECT_TRUE(Survey(almost, 150.0f, false).isMask);
}

TEST(MedialVoxelMaskSurvey, ANoisyMaskIsAMask)
{
  const Value noisy = [](const Index & voxel) {
    const auto hash = static_cast<std::uint32_t>(voxel[0] * 73856093 ^ voxel[1] * 19349663 ^ voxel[2] * 83492791);
    const bool isFlipped = hash * 2654435761u >> 24 < 64;
    return (GetLayer(voxel) <= 20) != isFlipped ? 250.0f : 50.0f;
  };
  EXPECT_TRUE(Survey(noisy, 51.0f, false).isMask);
  EXPECT_TRUE(Survey(noisy, 250.0f, true).isMask);
}

TEST(MedialVoxelMaskSurvey, WithoutABorderThereAreNoGrayValuesToMeasureOn)
{
  EXPECT_TRUE(Survey([](const Index &) { return 1.0f; }, 1.0f, false).isMask);
  EXPECT_TRUE(Survey([](const Index &) { return 0.0f; }, 1.0f, false).isMask);
}

TEST(MedialVoxelMaskSurvey, TheFilterMeasuresMasksOnTheObject)
{
  using namespace MedialVoxelTest;
  using MaskedImage = itk::Image<short, 3>;
  const Volume volume = AxisPlate({ { 20, 20, 20 } }, { { 0.5, 0.5, 0.8 } }, 2, 8, 4);
  auto         image = MakeImage<MaskedImage>(volume);
  for (const bool isReversed : { false, true })
  {
    for (std::size_t i = 0; i < volume.object.size(); ++i)
    {
      image->GetBufferPointer()[i] = (volume.object[i] != 0) == isReversed ? -50 : 250;
    }
    image->Modified();
    for (const double threshold : { -49.0, 100.0, 249.0 })
    {
      auto filter = itk::MedialVoxelImageFilter<MaskedImage>::New();
      filter->SetInput(image);
      filter->GenerateThicknessOn();
      filter->SubvoxelThicknessOn();
      isReversed ? filter->SetUpperThreshold(threshold) : filter->SetLowerThreshold(threshold);
      filter->Update();
      EXPECT_TRUE(filter->GetScan().isMask);
      for (const float value : PixelsOf(filter->GetThicknessOutput()))
      {
        EXPECT_TRUE(value == 0.0f || std::abs(value - 3.2f) < 1e-5f) << threshold << ' ' << value;
      }
      EXPECT_GT(filter->GetCounts().candidateCells, 0u);
    }
  }
}
