// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelVector3_h
#define itkMedialVoxelVector3_h

#include <array>
#include <cmath>
#include <cstdint>

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

/** a + weight * b */
inline MedialVoxelVector3
MedialVoxelAddScaled(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b, const double weight)
{
  return { { a[0] + weight * b[0], a[1] + weight * b[1], a[2] + weight * b[2] } };
}

/** Of length 1, unless it is zero. */
inline MedialVoxelVector3
MedialVoxelNormalized(const MedialVoxelVector3 & vector)
{
  const double length = MedialVoxelNorm(vector);
  return length > 0.0 ? MedialVoxelAddScaled({}, vector, 1.0 / length) : vector;
}

inline MedialVoxelVector3
MedialVoxelMiddle(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  return { { (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (a[2] + b[2]) / 2.0 } };
}

/** Of the angle between two vectors; 1 where one of them is zero. */
inline double
MedialVoxelCosine(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  const double lengths = MedialVoxelNorm(a) * MedialVoxelNorm(b);
  return lengths > 0.0 ? MedialVoxelDot(a, b) / lengths : 1.0;
}

/** std::floor() of numbers that fit: without vectors of SSE 4.1 the one of the library is a call. */
inline std::int64_t
MedialVoxelFloor(const double x)
{
  const auto truncated = static_cast<std::int64_t>(x);
  return truncated - (x < static_cast<double>(truncated) ? 1 : 0);
}

inline std::int64_t
MedialVoxelCeil(const double x)
{
  return -MedialVoxelFloor(-x);
}

} // end namespace itk

#endif
