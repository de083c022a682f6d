// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestParameters_h
#define MedialVoxelTestParameters_h

// What the kernels are told of the thickness of walls.

#include "itkMedialVoxelParameters.h"

namespace MedialVoxelTest
{
/** One thickness everywhere. */
inline itk::MedialVoxelParameters
FixedThickness(double tau)
{
  return itk::MedialVoxelParameters::ForThickness(tau, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
}

/** Each wall of 3 to 16 by its own thickness, as the programs do by default. */
inline itk::MedialVoxelParameters
AutomaticThickness()
{
  return itk::MedialVoxelParameters::ForWalls(3.0, 16.0, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestParameters_h
