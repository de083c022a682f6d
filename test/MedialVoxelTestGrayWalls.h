// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestGrayWalls_h
#define MedialVoxelTestGrayWalls_h

// Blurred walls of gray values, and the errors of their thickness.

#include "MedialVoxelTestSupport.h"
#include "MedialVoxelTestTilts.h"

#include "itkMedialVoxelImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace MedialVoxelTest
{
using GrayImage = itk::Image<short, 3>;
using GrayFilter = itk::MedialVoxelImageFilter<GrayImage>;
using DistanceFunction = std::function<double(const Vector3 &)>;

inline constexpr double AirValue = -1000.0;
inline constexpr double MetalValue = 3000.0;
inline constexpr double MiddleValue = 0.5 * (AirValue + MetalValue);

/** Values of walls around surfaces where a distance in millimeters is zero. A voxel holds the mean over a Gaussian of
 * its own size and that of the blur, as if the wall were flat there; without a blur over a voxel whose face lies along
 * the wall, a linear ramp. Another wall of 5 voxels begins behind a gap, if there is one. */
inline GrayImage::Pointer
BlurredWall(const Index3 &           size,
            const Vector3 &          spacing,
            double                   thickness,
            double                   blur,
            const DistanceFunction & distance,
            double                   gap = 0.0)
{
  const auto   image = MakeImage<GrayImage>(MakeVolume(size, spacing, [](const Index3 &) { return false; }));
  const double voxel = std::cbrt(spacing[0] * spacing[1] * spacing[2]);
  const double sigma = voxel * std::sqrt(blur * blur + 1.0 / 12);
  const auto   share = [&](double x) {
    return blur > 0.0 ? 0.5 * std::erfc(-x / (sigma * std::sqrt(2.0))) : std::clamp(0.5 + x / voxel, 0.0, 1.0);
  };
  itk::ImageRegionIteratorWithIndex<GrayImage> value(image, image->GetLargestPossibleRegion());
  for (; !value.IsAtEnd(); ++value)
  {
    Vector3 position;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      position[axis] = static_cast<double>(value.GetIndex()[axis]) * spacing[axis];
    }
    const double d = distance(position);
    const double other = 0.5 * thickness + gap;
    const double filled = share(0.5 * thickness - d) - share(-0.5 * thickness - d) +
                          (gap > 0.0 ? share(other + 5.0 * voxel - d) - share(other - d) : 0.0);
    value.Set(static_cast<short>(std::lround(AirValue + (MetalValue - AirValue) * filled)));
  }
  return image;
}

inline DistanceFunction
ToPlane(const Vector3 & center, const Vector3 & normal)
{
  return [=](const Vector3 & p) {
    const Vector3 r{ { p[0] - center[0], p[1] - center[1], p[2] - center[2] } };
    return Dot(r, normal) / std::sqrt(Dot(normal, normal));
  };
}

inline DistanceFunction
ToSphere(const Vector3 & center, double radius)
{
  return [=](const Vector3 & p) {
    const Vector3 r{ { p[0] - center[0], p[1] - center[1], p[2] - center[2] } };
    return std::sqrt(Dot(r, r)) - radius;
  };
}

inline GrayFilter::Pointer
MakeGrayFilter(GrayImage * image, double tau)
{
  auto filter = GrayFilter::New();
  filter->SetInput(image);
  filter->SetThickness(tau);
  filter->SetLowerThreshold(MiddleValue);
  filter->GenerateThicknessOn();
  filter->SubvoxelThicknessOn();
  return filter;
}

struct CellErrors
{
  double      mean{ 0.0 };
  double      deviation{ 0.0 };
  std::size_t cells{ 0 };
};

/** At the medial cells further than a margin from the faces of the image that are not marked as rims, of which there
 * are hardly any. */
inline CellErrors
ErrorsOf(GrayFilter * filter, double thickness, int margin, const std::function<bool(const Vector3 &)> & isWanted = {})
{
  filter->Update();
  auto        region = filter->GetOutput()->GetLargestPossibleRegion();
  double      sum = 0.0;
  double      squares = 0.0;
  CellErrors  errors;
  std::size_t rims = 0;
  itk::ImageRegionConstIteratorWithIndex<GrayFilter::OutputImageType>    label(filter->GetOutput(), region);
  itk::ImageRegionConstIteratorWithIndex<GrayFilter::ThicknessImageType> value(filter->GetThicknessOutput(), region);
  for (; !label.IsAtEnd(); ++label, ++value)
  {
    bool isInside = label.Get() >= 2;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto index = label.GetIndex()[axis];
      isInside = isInside && index >= margin && index < static_cast<int>(region.GetSize(axis)) - 1 - margin;
    }
    const auto index = label.GetIndex();
    if (isInside && isWanted)
    {
      isInside = isWanted({ { index[0] + 0.5, index[1] + 0.5, index[2] + 0.5 } });
    }
    if (isInside && value.Get() < 0.0f)
    {
      ++rims;
    }
    else if (isInside)
    {
      const double error = static_cast<double>(value.Get()) - thickness;
      sum += error;
      squares += error * error;
      ++errors.cells;
    }
  }
  EXPECT_LE(static_cast<double>(rims), 0.005 * static_cast<double>(errors.cells));
  errors.mean = sum / static_cast<double>(errors.cells);
  errors.deviation = std::sqrt(std::max(0.0, squares / static_cast<double>(errors.cells) - errors.mean * errors.mean));
  return errors;
}

/** With those of plates that are fitted. */
struct GrayPlateErrors : public PlateErrors
{
  unsigned int numberOfFits{ 0 };    ///< plates of which the scan is known
  double       largestOfFits{ 0.0 }; ///< of the means of these, without sign
};

/** Errors at the cells of a blurred plate; behind a gap there may be another one. */
inline GrayPlateErrors
MeasureGrayPlates(const Vector3 & normal, double thickness, double blur, double gap = 0.0)
{
  constexpr int   places = 7;
  GrayPlateErrors errors;
  for (int place = 0; place < places; ++place)
  {
    const auto distance = ToPlane(PlaceInVoxel(18.49, place, places), normal);
    const auto image = BlurredWall({ { 38, 38, 38 } }, UnitSpacing, thickness, blur, distance, gap);
    // The other wall is not measured.
    const auto filter = MakeGrayFilter(image, thickness < 6 ? 3.0 : 5.0);
    const auto part =
      ErrorsOf(filter, thickness, 10, [&](const Vector3 & p) { return std::abs(distance(p)) <= thickness / 2; });
    if (filter->GetScan().reason.empty())
    {
      ++errors.numberOfFits;
      errors.largestOfFits = std::max(errors.largestOfFits, std::abs(part.mean));
    }
    EXPECT_GT(part.cells, 200u);
    errors.Add(part.mean, part.deviation, places);
  }
  return errors;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestGrayWalls_h
