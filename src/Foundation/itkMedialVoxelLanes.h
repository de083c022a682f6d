// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLanes_h
#define itkMedialVoxelLanes_h

#include "itkMedialVoxelProcessors.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace itk
{

/** Numbers that are computed side by side. Compilers would split loops over them into single ones. */
constexpr std::size_t MedialVoxelNumberOfLanes = 8;

#if defined(__GNUC__)
// All functions are inlined, so that no two versions have to agree on how to return vectors.
#  pragma GCC diagnostic ignored "-Wpsabi"
using MedialVoxelLanes [[gnu::vector_size(MedialVoxelNumberOfLanes * sizeof(float))]] = float;
using MedialVoxelIntegerLanes [[gnu::vector_size(MedialVoxelNumberOfLanes * sizeof(float))]] = std::int32_t;

MEDIALVOXEL_INLINE MedialVoxelIntegerLanes
MedialVoxelTruncate(const MedialVoxelLanes & lanes)
{
  return __builtin_convertvector(lanes, MedialVoxelIntegerLanes);
}

MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelToFloat(const MedialVoxelIntegerLanes & lanes)
{
  return __builtin_convertvector(lanes, MedialVoxelLanes);
}

/** 2 to the power of exponents from -126 to 127, from the bits of a number. */
MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelPowerOfTwo(const MedialVoxelIntegerLanes & exponents)
{
  const MedialVoxelIntegerLanes bits = (exponents + 127) << 23;
  MedialVoxelLanes              powers;
  std::memcpy(&powers, &bits, sizeof(powers));
  return powers;
}

MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelSelect(const MedialVoxelIntegerLanes & condition, const MedialVoxelLanes & yes, const MedialVoxelLanes & no)
{
  return condition ? yes : no;
}
#else
#  error
#endif

MEDIALVOXEL_INLINE MedialVoxelLanes
MedialVoxelLoad(const float * const from)
{
  MedialVoxelLanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

MEDIALVOXEL_INLINE void
MedialVoxelStore(const MedialVoxelLanes & lanes, float * const to)
{
  std::memcpy(to, &lanes, sizeof(lanes));
}

/** In a fixed order. */
MEDIALVOXEL_INLINE double
MedialVoxelSumOf(const MedialVoxelLanes & lanes)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < MedialVoxelNumberOfLanes; ++i)
  {
    sum += static_cast<double>(lanes[i]);
  }
  return sum;
}

} // end namespace itk

#endif
