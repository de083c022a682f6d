// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestTilts_h
#define MedialVoxelTestTilts_h

// Directions and places of plates whose thickness is measured, and the errors over the places.

#include "MedialVoxelTestPhantoms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace MedialVoxelTest
{
/** A direction between the axes of the image. */
struct Tilt
{
  const char * name;
  Vector3      normal;
  double       layer; ///< distance of the layers of voxels that lie in a plate; 0 where it cuts them all
};

inline const Tilt Tilts[] = { { "along an axis", { { 0.0, 0.0, 1.0 } }, 1.0 },
                              { "15 degrees", { { 0.0, std::tan(3.14159265358979323846 / 12), 1.0 } }, 0.0 },
                              { "45 degrees (1,1,0)", { { 1.0, 1.0, 0.0 } }, std::sqrt(0.5) },
                              { "(1,2,5)", { { 1.0, 2.0, 5.0 } }, std::sqrt(1.0 / 30) },
                              { "(1,1,1)", { { 1.0, 1.0, 1.0 } }, std::sqrt(1.0 / 3) },
                              { "(0.37,0.61,0.7)", { { 0.37, 0.61, 0.7 } }, 0.0 } };

/** Where a plate lies between the voxels changes how many of their layers it holds. These places, from \a lowest on,
 * are spread over a voxel so that the layers across all of the tilts are met evenly. */
inline Vector3
PlaceInVoxel(double lowest, int place, int numberOfPlaces)
{
  const int steps[3] = { 1, 3, 5 };
  Vector3   result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis] = lowest + static_cast<double>(place * steps[axis] % numberOfPlaces) / numberOfPlaces;
  }
  return result;
}

/** Of the thickness of plates at several places. */
struct PlateErrors
{
  double mean{ 0.0 };                                         ///< over the places of the means of plates
  double smallest{ std::numeric_limits<double>::infinity() }; ///< mean of a plate
  double largest{ -std::numeric_limits<double>::infinity() }; ///< mean of a plate
  double deviation{ 0.0 };                                    ///< of the cells of a plate, mean over the places

  /** One of so many plates. */
  void
  Add(double meanOfPlate, double deviationOfPlate, int numberOfPlaces)
  {
    mean += meanOfPlate / numberOfPlaces;
    deviation += deviationOfPlate / numberOfPlaces;
    smallest = std::min(smallest, meanOfPlate);
    largest = std::max(largest, meanOfPlate);
  }
};
} // namespace MedialVoxelTest

#endif // MedialVoxelTestTilts_h
