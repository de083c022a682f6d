// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzScene_h
#define FuzzScene_h

#include "FuzzChoices.h"

#include "MedialVoxelTestOracles.h"

#include <optional>
#include <vector>

namespace MedialVoxelFuzz
{

/** An image: its object, the values and thresholds that say so, and where it lies. */
struct Scene
{
  MedialVoxelTest::Volume volume; ///< the object, with the spacing of the image
  std::vector<float>      values;
  std::optional<double>   lowerThreshold;
  std::optional<double>   upperThreshold;
  float                   backgroundValue{ 0 }; ///< without thresholds
  std::size_t             notANumbers{ 0 };

  bool               useImageSpacing{ true };
  std::array<int, 3> axisOf{ { 0, 1, 2 } }; ///< of space, along which an axis of the image goes
  std::array<int, 3> signOf{ { 1, 1, 1 } };
  int                start{ 0 }; ///< index of the first voxel along all axes

  bool
  HasThresholds() const
  {
    return lowerThreshold || upperThreshold;
  }

  /** The object in the units that the filters measure in. */
  MedialVoxelTest::Volume
  GetMeasured() const
  {
    MedialVoxelTest::Volume measured = volume;
    measured.spacing = useImageSpacing ? volume.spacing : MedialVoxelTest::UnitSpacing;
    return measured;
  }
};

/** Longer inputs only have more boxes one over the other, or bytes that change nothing. */
constexpr std::size_t MostBytesOfScene = 400;

/** The values of an image of numbers of this kind. */
enum class Values
{
  Whole, ///< from 0 to 255
  Real   ///< NaN too
};

/** All but the object: an image of at most 250 voxels, now and then 2500. Brute force takes the square of it. */
Scene
ChooseScene(Choices & choices, unsigned int dimension);

/** The object and the values, of all bytes that are left. */
void
FillScene(Choices & choices, Values kind, Scene & scene);

} // namespace MedialVoxelFuzz

#endif
