// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelElementQuality_h
#define itkMedialVoxelElementQuality_h

#include "itkMedialVoxelVector3.h"

#include "MedialVoxelExport.h"

namespace itk
{

/** Twice the area of a triangle, along its normal. */
inline MedialVoxelVector3
MedialVoxelTriangleNormal(const std::array<MedialVoxelVector3, 3> & corners)
{
  return MedialVoxelCross(MedialVoxelSubtract(corners[1], corners[0]), MedialVoxelSubtract(corners[2], corners[0]));
}

/** The scaled Jacobian of the Verdict library: 1 for an equilateral triangle, 0 for a flat one. */
MedialVoxel_EXPORT double
MedialVoxelScaledJacobian(const std::array<MedialVoxelVector3, 3> & corners);

/** The same for a quadrilateral: 1 for a rectangle, below 0 where a corner is turned in. Corners go round it. */
MedialVoxel_EXPORT double
MedialVoxelScaledJacobian(const std::array<MedialVoxelVector3, 4> & corners);

/** The aspect ratio of the Verdict library: 1 for an equilateral triangle, infinite for a flat one. */
MedialVoxel_EXPORT double
MedialVoxelAspectRatio(const std::array<MedialVoxelVector3, 3> & corners);

/** The same for a quadrilateral: 1 for a square. */
MedialVoxel_EXPORT double
MedialVoxelAspectRatio(const std::array<MedialVoxelVector3, 4> & corners);

} // end namespace itk

#endif
