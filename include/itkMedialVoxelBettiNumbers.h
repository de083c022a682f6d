// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBettiNumbers_h
#define itkMedialVoxelBettiNumbers_h

#include <cstdint>

namespace itk
{

/** \struct MedialVoxelBettiNumbers
 * \brief The topology of a set in numbers.
 * \ingroup MedialVoxel
 */
struct MedialVoxelBettiNumbers
{
  std::int64_t parts{ 0 };
  std::int64_t tunnels{ 0 };
  std::int64_t cavities{ 0 };
};

inline bool
operator==(const MedialVoxelBettiNumbers & a, const MedialVoxelBettiNumbers & b)
{
  return a.parts == b.parts && a.tunnels == b.tunnels && a.cavities == b.cavities;
}

inline MedialVoxelBettiNumbers &
operator+=(MedialVoxelBettiNumbers & sum, const MedialVoxelBettiNumbers & numbers)
{
  sum.parts += numbers.parts;
  sum.tunnels += numbers.tunnels;
  sum.cavities += numbers.cavities;
  return sum;
}

} // end namespace itk

#endif
