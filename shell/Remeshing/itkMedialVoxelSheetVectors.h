// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetVectors_h
#define itkMedialVoxelSheetVectors_h

#include "itkMedialVoxelVector3.h"

namespace itk
{

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

} // end namespace itk

#endif
