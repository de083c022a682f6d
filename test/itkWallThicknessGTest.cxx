// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The local thickness of walls against brute force over all cells and voxels, and its divisions.

#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestWallThickness.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkStreamingImageFilter.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace
{
using namespace MedialVoxelTest;

template <unsigned int VDimension>
typename ThicknessFilter<VDimension>::Pointer
MakeFilter(const Volume & volume, const double maximumThickness)
{
  auto filter = ThicknessFilter<VDimension>::New();
  filter->SetInput(MakeImage<MaskImage<VDimension>>(volume));
  filter->SetLargestBall(maximumThickness);
  return filter;
}

/** Returns the number of voxels that a wall covers. */
template <unsigned int VDimension>
itk::SizeValueType
ExpectBruteForce(const Volume & volume, const double maximum, const unsigned int tileSize, const std::string & name)
{
  auto filter = MakeFilter<VDimension>(volume, maximum);
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, tileSize);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 1 + tileSize / 2);
  filter->Update();
  const auto expected = ExpectedWallThickness<VDimension>(volume, maximum);
  EXPECT_TRUE(AreEqualOrNan(PixelsOf(filter->GetOutput()), expected)) << name << ", maximum " << maximum;
  const auto count = [&](const auto & isCounted) {
    return static_cast<itk::SizeValueType>(std::count_if(expected.begin(), expected.end(), isCounted));
  };
  EXPECT_EQ(filter->GetNumberOfVoxelsAtMaximum(),
            count([maximum](const float value) { return value == static_cast<float>(maximum); }));
  EXPECT_EQ(filter->GetNumberOfVoxelsWithoutWall(), count([](const float value) { return std::isnan(value); }));
  EXPECT_EQ(filter->GetCounts().objectVoxels,
            static_cast<itk::SizeValueType>(std::count(volume.object.begin(), volume.object.end(), 1)));
  return count([](const float value) { return value > 0.0f; });
}

const Vector3 Spacings[] = { { { 1, 1, 1 } }, { { 0.7, 0.7, 1.2 } }, { { 1.3, 0.8, 0.9 } } };

Volume
Gyroid(const Index3 & size)
{
  return MakeVolume(size, UnitSpacing, [](const Index3 & at) {
    const double x = 0.35 * at[0];
    const double y = 0.35 * at[1];
    const double z = 0.35 * at[2];
    return std::abs(std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x)) < 0.5;
  });
}

/** Of the object voxels that are not near the faces of a volume of 40 voxels. */
double
MeanInTheMiddle(const Volume & volume, const std::vector<float> & values)
{
  double      sum = 0.0;
  std::size_t number = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const Index3 at = volume.IndexAt(i);
    if (values[i] > 0.0f && std::all_of(at.begin(), at.end(), [](const int x) { return x >= 14 && x < 26; }))
    {
      sum += values[i];
      ++number;
    }
  }
  EXPECT_GT(number, 100u);
  return sum / static_cast<double>(number);
}
} // namespace

TEST(WallThickness, OfPhantomsEqualsBruteForce)
{
  const Index3 size{ { 28, 26, 24 } };
  EXPECT_GT(ExpectBruteForce<3>(RandomBoxes(size, UnitSpacing, 12, 3), 12.0, 7, "boxes"), 100u);
  EXPECT_GT(ExpectBruteForce<3>(AxisPlate(size, { { 0.5, 0.75, 1.5 } }, 1, 8, 5), 12.0, 9, "plate along an axis"),
            100u);
  EXPECT_GT(ExpectBruteForce<3>(TiltedPlate(size, { { 14, 13, 12 } }, { { 1, 2, 5 } }, 4.3), 6.0, 11, "tilted plate"),
            100u);
  EXPECT_GT(ExpectBruteForce<3>(SphericalShell(size, { { 14, 13, 12 } }, 9, 3), 5.0, 8, "shell"), 100u);
  EXPECT_EQ(ExpectBruteForce<3>(Ball(size, UnitSpacing, { { 14, 13, 12 } }, 9), 30.0, 6, "ball"), 0u);
  EXPECT_GT(ExpectBruteForce<3>(TeeJunction(size, 6, 4), 9.0, 10, "tee"), 100u);
  EXPECT_GT(ExpectBruteForce<3>(EllJunction(size, 6, 5), 9.0, 5, "ell"), 100u);
  EXPECT_GT(ExpectBruteForce<3>(LatticeOfHoles(size, UnitSpacing, 7), 8.0, 7, "holes"), 100u);
  EXPECT_GT(ExpectBruteForce<3>(Gyroid(size), 7.5, 6, "gyroid"), 100u);
  EXPECT_GT(ExpectBruteForce<3>(RandomVolume({ { 14, 13, 12 } }, UnitSpacing, 0.9, 8), 5.0, 5, "noise"), 100u);
}

TEST(WallThickness, WithUnequalSpacingEqualsBruteForce)
{
  unsigned int seed = 40;
  for (const Vector3 & spacing : Spacings)
  {
    for (const double maximum : { 2.5, 6.0, 40.0 })
    {
      EXPECT_GT(ExpectBruteForce<3>(RandomBoxes({ { 24, 21, 19 } }, spacing, 10, seed), maximum, 5 + seed % 9, "boxes"),
                50u);
      ++seed;
    }
  }
}

TEST(WallThickness, OfPicturesEqualsBruteForce)
{
  for (const Vector3 & spacing : Spacings)
  {
    const Volume volume = RandomBoxes({ { 60, 50, 1 } }, spacing, 12, 5);
    EXPECT_GT(ExpectBruteForce<2>(volume, 9.0, 0, "picture"), 100u);
    EXPECT_GT(ExpectBruteForce<3>(volume, 9.0, 13, "slice"), 100u);
  }
}

TEST(WallThickness, AnyDivisionGivesTheSameBytes)
{
  const Volume volume = RandomBoxes({ { 60, 52, 47 } }, { { 0.7, 0.7, 1.2 } }, 30, 12);
  auto         reference = MakeFilter<3>(volume, 9.0);
  reference->Update();
  const auto expected = PixelsOf(reference->GetOutput());
  for (const auto & cut : { std::make_pair(3u, 11u), { 1u, 17u }, { 64u, 64u } })
  {
    auto filter = MakeFilter<3>(volume, 9.0);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, cut.first);
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, cut.second);
    filter->SetNumberOfWorkUnits(3);
    filter->Update();
    EXPECT_TRUE(AreEqualOrNan(PixelsOf(filter->GetOutput()), expected)) << cut.first;
    EXPECT_EQ(filter->GetNumberOfVoxelsWithoutWall(), reference->GetNumberOfVoxelsWithoutWall());
  }
  for (const unsigned int divisions : { 5u, 47u })
  {
    auto filter = MakeFilter<3>(volume, 9.0);
    auto streamer = itk::StreamingImageFilter<itk::Image<float, 3>, itk::Image<float, 3>>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    EXPECT_TRUE(AreEqualOrNan(PixelsOf(streamer->GetOutput()), expected)) << divisions;
  }
  auto limited = MakeFilter<3>(volume, 9.0);
  limited->SetNumberOfWorkUnits(1);
  limited->SetWorkingMemoryLimit(itk::SizeValueType{ 20 } << 20);
  limited->Update();
  EXPECT_TRUE(AreEqualOrNan(PixelsOf(limited->GetOutput()), expected));
}

TEST(WallThickness, OnGrayValuesEqualsBruteForce)
{
  using GrayImage = itk::Image<float, 3>;
  const Vector3 middle{ { 20, 19, 18 } };
  for (const Vector3 & spacing : Spacings)
  {
    // Two crossing walls, blurred; their thickness is not that of a number of voxels.
    const auto valueAt = [&middle](const Index3 & at) {
      const auto shareOf = [&](const Vector3 & normal, const double thickness) {
        double distance = 0.0;
        for (int axis = 0; axis < 3; ++axis)
        {
          distance += normal[axis] * (at[axis] - middle[axis]) / std::sqrt(Dot(normal, normal));
        }
        return 0.5 * (std::erf((distance + thickness / 2) / 1.1) - std::erf((distance - thickness / 2) / 1.1));
      };
      return static_cast<float>(10 + 90 * std::max(shareOf({ { 1, 2, 5 } }, 6.4), shareOf({ { 1, -0.2, 0 } }, 3.3)));
    };
    const Volume volume =
      MakeVolume({ { 40, 38, 36 } }, spacing, [&](const Index3 & at) { return valueAt(at) >= 55.0f; });
    const auto image = MakeImage<GrayImage>(volume);
    for (std::size_t i = 0; i < volume.object.size(); ++i)
    {
      image->GetBufferPointer()[i] = valueAt(volume.IndexAt(i));
    }
    auto cells = itk::MedialVoxelImageFilter<GrayImage>::New();
    cells->SetInput(image);
    cells->SetLowerThreshold(55);
    cells->SubvoxelThicknessOn();
    const auto expected = ExpectedWallThickness(volume, ThicknessOfCells(*cells), 9.0);
    EXPECT_TRUE(cells->GetScan().scan.has_value());

    auto filter = itk::LocalThicknessImageFilter<GrayImage>::New();
    filter->SetInput(image);
    filter->SetLowerThreshold(55);
    filter->SetLargestBall(9.0);
    filter->SubvoxelThicknessOn();
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, 13);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 7);
    filter->Update();
    const auto values = PixelsOf(filter->GetOutput());
    EXPECT_TRUE(AreEqualOrNan(values, expected));
    filter->SubvoxelThicknessOff();
    filter->Update();
    EXPECT_FALSE(AreEqualOrNan(PixelsOf(filter->GetOutput()), expected));
  }
}

TEST(WallThickness, MasksAreMeasuredHalfwayBetweenTheirValues)
{
  auto filter = MakeFilter<3>(AxisPlate({ { 12, 12, 12 } }, UnitSpacing, 2, 3, 4), 8.0);
  filter->Update();
  const auto expected = PixelsOf(filter->GetOutput());
  filter->SubvoxelThicknessOn();
  filter->SetLowerThreshold(1);
  filter->Update();
  const auto values = PixelsOf(filter->GetOutput());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_TRUE(std::isnan(values[i]) ? std::isnan(expected[i]) : std::abs(values[i] - expected[i]) < 1e-5f)
      << values[i] << ' ' << expected[i];
  }
}

TEST(WallThickness, OnGrayValuesNeedsAThresholdAndWalls)
{
  auto filter = MakeFilter<3>(AxisPlate({ { 9, 9, 9 } }, UnitSpacing, 2, 3, 2), 5.0);
  EXPECT_FALSE(filter->GetSubvoxelThickness());
  filter->SubvoxelThicknessOn();
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->SetLowerThreshold(1);
  EXPECT_NO_THROW(filter->Update());
  filter->SetMethod(itk::MedialVoxelLocalThicknessMethod::Sphere);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
}

TEST(WallThickness, PlatesAlongAnAxisReadTheirThickness)
{
  const Vector3 spacing{ { 0.5, 0.75, 1.5 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int layers : { 1, 2, 3, 4, 7, 8, 16 })
    {
      const Volume volume = AxisPlate({ { 30, 30, 30 } }, spacing, axis, 6, layers);
      auto         filter = MakeFilter<3>(volume, 30.0);
      filter->Update();
      const auto  values = PixelsOf(filter->GetOutput());
      const auto  wanted = static_cast<float>(layers * spacing[axis]);
      std::size_t others = 0;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        others += values[i] != (volume.object[i] ? wanted : 0.0f) ? 1 : 0;
      }
      EXPECT_EQ(others, 0u) << layers << " along " << axis;
    }
  }
}

TEST(WallThickness, TiltedPlatesReadTheirThicknessOnAverage)
{
  const Vector3 normals[] = {
    { { 1, 1, 0 } }, { { 1, 1, 1 } }, { { 1, 2, 0 } }, { { 1, 2, 5 } }, { { 0.31, 0.57, 1 } }
  };
  for (const double thickness : { 3.0, 5.0, 8.0, 12.0 })
  {
    double mean = 0.0;
    for (const Vector3 & normal : normals)
    {
      // Whole normals repeat after the reciprocal of their length.
      for (const double shift : { 0.125, 0.375, 0.625, 0.875 })
      {
        const double way = shift / Dot(normal, normal);
        const Volume volume = TiltedPlate({ { 40, 40, 40 } },
                                          { { 20 + way * normal[0], 20 + way * normal[1], 20 + way * normal[2] } },
                                          normal,
                                          thickness);
        auto         filter = MakeFilter<3>(volume, 32.0);
        filter->Update();
        mean += MeanInTheMiddle(volume, PixelsOf(filter->GetOutput())) / 20.0;
      }
    }
    EXPECT_NEAR(mean, thickness, 0.15);
  }
}
