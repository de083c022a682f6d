// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNontrivialEdges.h"

#include "itkMedialVoxelProcessors.h"

namespace itk
{

namespace
{

/** Edges that are tested together. */
constexpr std::int64_t GroupSize = 16;

/** Number whose sign bit is set unless -1 <= lower - upper - step <= 1. Unsigned, because undefined displacements
 * wrap. */
inline std::uint32_t
NontrivialSign(const std::int32_t lower, const std::int32_t upper, const std::uint32_t step)
{
  const std::uint32_t difference = static_cast<std::uint32_t>(lower) - static_cast<std::uint32_t>(upper) - step;
  return (difference + 1) | (1 - difference);
}

/** Bits of the edges of a group that are nontrivial. */
MEDIALVOXEL_INLINE std::uint32_t
                   NontrivialOfGroup(const MedialVoxelDisplacementRows & lower,
                                     const MedialVoxelDisplacementRows & upper,
                                     const unsigned int                  axis,
                                     const std::int64_t                  begin,
                                     const std::int64_t                  number)
{
  const std::uint32_t steps[3] = { axis == 0 ? 1u : 0u, axis == 1 ? 1u : 0u, axis == 2 ? 1u : 0u };
  std::uint32_t       nontrivial[GroupSize] = {};
  for (std::int64_t i = 0; i < number; ++i)
  {
    const std::int64_t at = begin + i;
    nontrivial[i] = NontrivialSign(lower[0][at], upper[0][at], steps[0]) |
                    NontrivialSign(lower[1][at], upper[1][at], steps[1]) |
                    NontrivialSign(lower[2][at], upper[2][at], steps[2]);
  }
  std::uint32_t bits = 0;
  for (std::int64_t i = 0; i < GroupSize; ++i)
  {
    bits |= (nontrivial[i] >> 31) << i;
  }
  return bits;
}

MEDIALVOXEL_INLINE std::uint64_t
                   FindNontrivial(const MedialVoxelDisplacementRows & lower,
                                  const MedialVoxelDisplacementRows & upper,
                                  const unsigned int                  axis,
                                  const std::uint64_t                 edges,
                                  const std::int64_t                  number)
{
  std::uint64_t result = 0;
  for (std::int64_t begin = 0; begin < number; begin += GroupSize)
  {
    if (((edges >> begin) & ((std::uint64_t{ 1 } << GroupSize) - 1)) == 0)
    {
      continue;
    }
    // A constant number of edges makes a loop without remainder.
    const std::uint64_t bits = number - begin >= GroupSize
                                 ? NontrivialOfGroup(lower, upper, axis, begin, GroupSize)
                                 : NontrivialOfGroup(lower, upper, axis, begin, number - begin);
    result |= bits << begin;
  }
  return result & edges;
}

} // namespace

std::uint64_t
MedialVoxelNontrivialEdges(const MedialVoxelDisplacementRows & lower,
                           const MedialVoxelDisplacementRows & upper,
                           const unsigned int                  axis,
                           const std::uint64_t                 edges,
                           const std::int64_t                  number)
{
  return MedialVoxelKernel<FindNontrivial>::Run(lower, upper, axis, edges, number);
}

} // end namespace itk
