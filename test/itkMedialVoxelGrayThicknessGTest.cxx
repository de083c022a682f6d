// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Thickness measured on gray values: errors on blurred walls, the same bytes in any cut, input that is read once.

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialVoxelGrayThickness.h"

#include "MedialVoxelTestGrayWalls.h"
#include "MedialVoxelTestRuns.h"

#include "itkStreamingImageFilter.h"

namespace
{
using namespace MedialVoxelTest;
} // namespace

TEST(MedialVoxelGrayThickness, BlurredPlatesAreMeasuredWithinAFractionOfAVoxel)
{
  for (const Tilt & tilt : Tilts)
  {
    for (const double blur : { 0.0, 0.5, 1.0 })
    {
      for (const double thickness : { 3.0, 4.3, 7.0 })
      {
        const GrayPlateErrors errors = MeasureGrayPlates(tilt.normal, thickness, blur);
        const std::string     name =
          std::string(tilt.name) + " blur " + std::to_string(blur) + " thickness " + std::to_string(thickness);
        EXPECT_LT(errors.largestOfFits, 0.03) << name;
        // Crossings err with the place. Walls of three voxels that are blurred by one hardly reach their material.
        if (errors.numberOfFits == 0)
        {
          EXPECT_LT(std::abs(errors.mean), blur == 1.0 && thickness == 3.0 ? 0.03 : 0.015) << name;
        }
        EXPECT_LT(errors.deviation, 0.06) << name;
        // Along an axis all cells see the same; what a line sees between two voxels is not linear.
        EXPECT_LT(std::max(-errors.smallest, errors.largest), 0.18) << name;
      }
    }
  }
}

TEST(MedialVoxelGrayThickness, PlatesBesideNarrowGapsAreMeasured)
{
  for (const Tilt & tilt : Tilts)
  {
    for (const double thickness : { 2.0, 4.3 })
    {
      const GrayPlateErrors errors = MeasureGrayPlates(tilt.normal, thickness, 0.0, 1.0);
      EXPECT_LT(std::abs(errors.mean), 0.15) << tilt.name << ' ' << thickness;
      EXPECT_LT(std::abs(MeasureGrayPlates(tilt.normal, thickness, 0.0, 2.0).mean), 0.02)
        << tilt.name << ' ' << thickness;
    }
  }
  // Voxels that are full or empty.
  for (const double thickness : { 1.0, 2.0, 4.0, 8.0 })
  {
    const Vector3 normal{ { 0, 0, 1 } };
    const Vector3 center{ { 20, 20, std::fmod(thickness, 2.0) == 0.0 ? 18.5 : 19.0 } };
    const auto    distance = ToPlane(center, normal);
    const auto    image = BlurredWall({ { 40, 40, 40 } }, UnitSpacing, thickness, 0.0, distance, 1.0);
    const auto    errors = ErrorsOf(MakeGrayFilter(image, 2.0), thickness, 2, [&](const Vector3 & p) {
      return std::abs(distance(p)) <= thickness / 2;
    });
    EXPECT_NEAR(errors.mean, 0.0, 1e-6) << thickness;
    EXPECT_NEAR(errors.deviation, 0.0, 1e-3) << thickness;
  }
}

TEST(MedialVoxelGrayThickness, BlurredShellsAreMeasuredWithinAFractionOfAVoxel)
{
  for (const double blur : { 0.5, 1.0 })
  {
    for (const double thickness : { 3.0, 5.0, 8.0 })
    {
      const auto image =
        BlurredWall({ { 64, 64, 64 } }, UnitSpacing, thickness, blur, ToSphere({ { 31.4, 31.7, 31.5 } }, 24.0));
      const auto errors = ErrorsOf(MakeGrayFilter(image, thickness < 6 ? 3.0 : 5.0), thickness, 0);
      EXPECT_LT(std::abs(errors.mean), 0.06) << blur << ' ' << thickness;
      EXPECT_LT(errors.deviation, 0.06) << blur << ' ' << thickness;
    }
  }
}

TEST(MedialVoxelGrayThickness, UnequalSpacingIsMeasuredInItsUnits)
{
  const Vector3 spacing{ { 0.4, 0.5, 0.6 } };
  for (const Vector3 & normal :
       { Vector3{ { 1, 0, 0 } }, Vector3{ { 0.3, 0.2, 0.93 } }, Vector3{ { 0.6, -0.7, 0.3 } } })
  {
    for (const double thickness : { 2.0, 3.1 })
    {
      const auto image =
        BlurredWall({ { 50, 40, 36 } }, spacing, thickness, 0.5, ToPlane({ { 9.8, 9.9, 10.3 } }, normal));
      const auto errors = ErrorsOf(MakeGrayFilter(image, 1.5), thickness, 9);
      EXPECT_GT(errors.cells, 200u);
      EXPECT_LT(std::abs(errors.mean), 0.06 * 0.6) << normal[0] << ' ' << thickness;
    }
  }
}

TEST(MedialVoxelGrayThickness, AnObjectBelowAThresholdIsMeasuredToo)
{
  // A gap in metal, from both sides of which the values rise.
  auto image =
    BlurredWall({ { 40, 40, 40 } }, UnitSpacing, 4.3, 0.5, ToPlane({ { 19.3, 19.6, 19.4 } }, { { 1, 2, 5 } }));
  const auto bright = ErrorsOf(MakeGrayFilter(image, 3.0), 4.3, 10);
  for (itk::ImageRegionIteratorWithIndex<GrayImage> value(image, image->GetLargestPossibleRegion()); !value.IsAtEnd();
       ++value)
  {
    value.Set(static_cast<short>(AirValue + MetalValue - value.Get()));
  }
  auto filter = MakeGrayFilter(image, 3.0);
  filter->UnsetThresholds();
  filter->SetUpperThreshold(MiddleValue);
  const auto dark = ErrorsOf(filter, 4.3, 10);
  EXPECT_NEAR(dark.mean, bright.mean, 1e-3);
  EXPECT_NEAR(dark.deviation, bright.deviation, 1e-3);
}

TEST(MedialVoxelGrayThickness, AnyCutGivesTheSameBytes)
{
  // Thin and thick: boundary points beside the tile, and so far away that windows grow.
  for (const double thickness : { 3.3, 26.0 })
  {
    auto image = BlurredWall({ { 50, 44, 48 } },
                             { { 1.0, 1.1, 0.9 } },
                             thickness,
                             0.7,
                             ToPlane({ { 25.1, 24.3, 21.6 } }, { { 0.2, 0.4, 1 } }));
    auto reference = MakeGrayFilter(image, 3.0);
    reference->Update();
    const auto expected = PixelsOf(reference->GetThicknessOutput());
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), thickness - 0.5);
    auto binary = MakeGrayFilter(image, 3.0);
    binary->SubvoxelThicknessOff();
    binary->Update();
    EXPECT_NE(PixelsOf(binary->GetThicknessOutput()), expected);
    EXPECT_EQ(PixelsOf(binary->GetOutput()), PixelsOf(reference->GetOutput()));
    for (const auto & cut : { std::make_pair(2u, 7u), { 1u, 5u }, { 64u, 64u } })
    {
      auto filter = MakeGrayFilter(image, 3.0);
      itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, cut.first);
      itk::MedialVoxelFilterAccess::SetTileSize(*filter, cut.second);
      filter->SetNumberOfWorkUnits(3);
      filter->Update();
      EXPECT_TRUE(AreEqual(PixelsOf(filter->GetThicknessOutput()), expected)) << cut.first;
    }
    for (const unsigned int divisions : { 5u, 48u })
    {
      auto filter = MakeGrayFilter(image, 3.0);
      auto streamer = itk::StreamingImageFilter<GrayFilter::ThicknessImageType, GrayFilter::ThicknessImageType>::New();
      streamer->SetInput(filter->GetThicknessOutput());
      streamer->SetNumberOfStreamDivisions(divisions);
      streamer->Update();
      EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), expected)) << divisions;
    }
    auto limited = MakeGrayFilter(image, 3.0);
    limited->SetNumberOfWorkUnits(1);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*limited, 1);
    limited->SetWorkingMemoryLimit(itk::SizeValueType{ 8 } << 20);
    limited->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(limited->GetThicknessOutput()), expected));
  }
}

TEST(MedialVoxelGrayThickness, ThinPartsAreReadOnce)
{
  const auto image =
    BlurredWall({ { 60, 24, 90 } }, UnitSpacing, 3.0, 0.5, ToPlane({ { 0.0, 11.2, 0.0 } }, { { 0, 1, 0 } }));
  auto whole = MakeGrayFilter(image, 3.0);
  whole->Update();
  for (const unsigned int divisions : { 1u, 9u })
  {
    auto source = RecordingSource<GrayImage>::New();
    source->SetImage(image);
    auto filter = MakeGrayFilter(source->GetOutput(), 3.0);
    auto streamer = itk::StreamingImageFilter<GrayFilter::ThicknessImageType, GrayFilter::ThicknessImageType>::New();
    streamer->SetInput(filter->GetThicknessOutput());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), PixelsOf(whole->GetThicknessOutput())));
    std::size_t asked = 0;
    for (const auto & region : source->GetRequests())
    {
      asked += region.GetNumberOfPixels();
    }
    // The survey of the scan reads before, in blocks that overlap.
    EXPECT_LE(asked, 4 * image->GetLargestPossibleRegion().GetNumberOfPixels());
    EXPECT_EQ(itk::MedialVoxelFilterAccess::GetSums(*filter).recomputedVoxels, 0u);
  }
}

TEST(MedialVoxelGrayThickness, ValuesOfTwoMaterialsAloneAreMeasuredFinitely)
{
  // No gray between air and metal, rims, corners and specks: nothing is known better, nothing may break.
  auto image = MakeImage<GrayImage>(RandomBoxes({ { 40, 30, 26 } }, UnitSpacing, 30, 98), 0, 3000, -1000);
  auto filter = MakeGrayFilter(image, 2.0);
  filter->Update();
  const auto labels = PixelsOf(filter->GetOutput());
  const auto values = PixelsOf(filter->GetThicknessOutput());
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    EXPECT_TRUE(std::isfinite(values[i]) && (values[i] != 0.0f) == (labels[i] >= 2)) << i << ' ' << values[i];
  }
}

TEST(MedialVoxelGrayThickness, VoxelsThatAreNotANumberAreLeftOut)
{
  using RealImage = itk::Image<float, 3>;
  auto image = MakeImage<RealImage>(AxisPlate({ { 20, 20, 20 } }, UnitSpacing, 2, 8, 4));
  for (int x = 4; x < 16; ++x)
  {
    image->SetPixel({ { x, 10, 7 } }, std::numeric_limits<float>::quiet_NaN());
  }
  auto filter = itk::MedialVoxelImageFilter<RealImage>::New();
  filter->SetInput(image);
  filter->SetLowerThreshold(0.5);
  filter->GenerateThicknessOn();
  filter->SubvoxelThicknessOn();
  filter->Update();
  for (const float value : PixelsOf(filter->GetThicknessOutput()))
  {
    EXPECT_TRUE(value == 0.0f || std::abs(value - 4.0f) < 0.01f) << value;
  }
}

TEST(MedialVoxelGrayThickness, NeedsAThreshold)
{
  auto filter = MedialFilter<3>::New();
  EXPECT_FALSE(filter->GetSubvoxelThickness());
  filter->SetInput(MakeImage<MaskImage<3>>(AxisPlate({ { 9, 9, 9 } }, UnitSpacing, 2, 3, 2)));
  filter->SubvoxelThicknessOn();
  try
  {
    filter->Update();
    FAIL() << "no exception";
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find("LowerThreshold"), std::string::npos);
  }
  filter->SetLowerThreshold(1);
  EXPECT_NO_THROW(filter->Update());
}

TEST(MedialVoxelGray, KeepsWhatBothBoxesHave)
{
  std::mt19937 generator(99);
  const auto   random = [&](int most) {
    return static_cast<std::int64_t>(generator() % static_cast<unsigned int>(most));
  };
  itk::MedialVoxelGray gray;
  for (int move = 0; move < 300; ++move)
  {
    const itk::MedialVoxelBox old = gray.GetBox();
    itk::MedialVoxelBox       box;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const bool stays = axis < 2 && move % 3 != 0 && !old.IsEmpty();
      box.lower[axis] = stays ? old.lower[axis] : random(6);
      box.upper[axis] = stays ? old.upper[axis] : box.lower[axis] + 1 + random(6);
    }
    const std::uint64_t bytes = gray.GetBytesToReframe(box, box);
    EXPECT_GE(bytes, itk::MedialVoxelGray::GetBytes(box));
    gray.Reframe(box, box);
    EXPECT_EQ(gray.GetBox().lower, box.lower);
    EXPECT_EQ(gray.GetBox().upper, box.upper);
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x)
        {
          const auto expected = static_cast<float>(x + 100 * y + 10000 * z);
          if (old.Contains(itk::MedialVoxelIndex{ { x, y, z } }))
          {
            ASSERT_EQ(gray.Get({ { x, y, z } }), expected);
          }
          gray.GetRow(y, z)[x - box.lower[0]] = expected;
        }
      }
    }
  }
}
