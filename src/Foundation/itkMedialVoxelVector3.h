// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelVector3_h
#define itkMedialVoxelVector3_h

#include <array>
#include <cmath>

namespace itk
{

/** Three coordinates. Sums are evaluated in the order x, y, z, which results depend on. */
using MedialVoxelVector3 = std::array<double, 3>;

inline MedialVoxelVector3
MedialVoxelSubtract(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}

inline double
MedialVoxelDot(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

inline MedialVoxelVector3
MedialVoxelCross(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  return { { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] } };
}

inline double
MedialVoxelNorm(const MedialVoxelVector3 & a)
{
  return std::sqrt(MedialVoxelDot(a, a));
}

} // end namespace itk

#endif
