// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestTiltedPlates_h
#define MedialVoxelTestTiltedPlates_h

// The thickness of plates of voxels in several tilts, measured on the object.

#include "MedialVoxelTestMeasurement.h"
#include "MedialVoxelTestTilts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace MedialVoxelTest
{
/** Cells further than the thickness of the walls from the faces of a cube. */
inline Measurement::Test
Inside(int size, int margin)
{
  return [=](const itk::MedialVoxelIndex & cell) {
    for (const auto index : cell)
    {
      if (index < margin || index >= size - 1 - margin)
      {
        return false;
      }
    }
    return true;
  };
}

/** Errors at the cells of a plate; on one side or on both there is another one behind a gap. */
inline PlateErrors
MeasureTiltedPlates(const Vector3 & normal, double thickness, double gap = 0.0, int numberOfOthers = 0)
{
  constexpr int size = 44;
  constexpr int places = 13;
  const double  length = std::sqrt(Dot(normal, normal));
  PlateErrors   errors;
  for (int place = 0; place < places; ++place)
  {
    const Vector3 center = PlaceInVoxel(20.99, place, places);
    const auto    heightOf = [&](double x, double y, double z) {
      return Dot({ { x - center[0], y - center[1], z - center[2] } }, normal) / length;
    };
    const Volume volume = MakeVolume({ { size, size, size } }, UnitSpacing, [&](const Index3 & v) {
      const double height = heightOf(v[0], v[1], v[2]);
      const double above = (numberOfOthers == 2 ? std::abs(height) : height) - thickness / 2;
      return std::abs(height) <= thickness / 2 || (numberOfOthers > 0 && above > gap && above <= gap + 5.0);
    });
    const auto   isInside = Inside(size, 10);
    const auto   isInPlate = [&](const itk::MedialVoxelIndex & cell) {
      const auto centerOf = [&](int axis) { return static_cast<double>(cell[axis]) + 0.5; };
      return isInside(cell) && std::abs(heightOf(centerOf(0), centerOf(1), centerOf(2))) <= thickness / 2;
    };
    const Measurement measured(volume, 3.0, isInPlate);
    EXPECT_GT(measured.GetValues().size(), 300u);
    errors.Add(measured.Mean() - thickness, measured.Deviation(), places);
  }
  return errors;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestTiltedPlates_h
