// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelElementary_h
#define itkMedialVoxelElementary_h

#include "MedialVoxelExport.h"

namespace itk
{

/** Elementary functions from sums, products, quotients and square roots, which processors round in one way. Those of C
 * libraries differ in the last bit from one system to another, and a job may run on several. */
namespace MedialVoxelElementary
{

/** In radians, within 4 ulp. A cosine beyond 1, as rounding leaves it, counts as 1. */
MedialVoxel_EXPORT double
ArcCosine(double cosine);

/** Of an angle of at most 10 radians: within 2e-15. */
MedialVoxel_EXPORT double
Sine(double radians);
MedialVoxel_EXPORT double
Cosine(double radians);

/** Within 8 ulp for |x| up to 1/4, and 32 |x| ulp beyond. */
MedialVoxel_EXPORT double
Exponential(double x);

/** Of a positive number: within 4 ulp. */
MedialVoxel_EXPORT double
Logarithm(double x);

/** Of a positive base: the error is that of Exponential(exponent * Logarithm(base)). */
MedialVoxel_EXPORT double
Power(double base, double exponent);

} // end namespace MedialVoxelElementary
} // end namespace itk

#endif
