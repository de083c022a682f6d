// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRowPass.h"

#include "itkMedialVoxelLanes.h"

#include <algorithm>
#include <cstring>

namespace itk
{

namespace
{

/** First attempt of a search about which nothing is known. */
constexpr std::int64_t FirstReach = 16;

/** Keys that are added and compared at once. */
constexpr std::int64_t KeysAtOnce = 4;
using Keys = MedialVoxelLanesOf<double, KeysAtOnce>;

/** Smallest of keys[j] + steps[j] for j in [begin, end). */
MEDIALVOXEL_INLINE double
FindSmallestSum(const double * const keys, const double * const steps, std::int64_t begin, const std::int64_t end)
{
  double                 smallest = MedialVoxelSiteKey::NoSite;
  constexpr std::int64_t vectors = 2;
  constexpr std::int64_t lanes = vectors * KeysAtOnce;
  if (end - begin >= lanes)
  {
    Keys best[vectors];
    std::fill(best, best + vectors, Keys{} + smallest);
    for (; begin + lanes <= end; begin += lanes)
    {
      for (std::int64_t i = 0; i < vectors; ++i)
      {
        const std::int64_t at = begin + i * KeysAtOnce;
        const Keys         sum = MedialVoxelLoad<Keys>(keys + at) + MedialVoxelLoad<Keys>(steps + at);
        best[i] = MedialVoxelSelect(sum < best[i], sum, best[i]);
      }
    }
    double values[lanes];
    std::memcpy(values, best, sizeof(values));
    smallest = *std::min_element(values, values + lanes);
  }
  for (; begin < end; ++begin)
  {
    smallest = std::min(smallest, keys[begin] + steps[begin]);
  }
  return smallest;
}

/** Smallest of keys[j] + steps[lane - j] for j in [begin, end), for all lanes of a block. */
MEDIALVOXEL_INLINE void
FindSmallestSums(const double * const keys,
                 const double * const steps,
                 const std::int64_t   begin,
                 const std::int64_t   end,
                 double * const       result)
{
  constexpr std::int64_t vectors = MedialVoxelRowPass::BlockSize / KeysAtOnce;
  Keys                   best[vectors];
  std::fill(best, best + vectors, Keys{} + MedialVoxelSiteKey::NoSite);
  for (std::int64_t j = begin; j < end; ++j)
  {
    for (std::int64_t i = 0; i < vectors; ++i)
    {
      const Keys sum = MedialVoxelLoad<Keys>(steps - j + i * KeysAtOnce) + keys[j];
      best[i] = MedialVoxelSelect(sum < best[i], sum, best[i]);
    }
  }
  std::memcpy(result, best, sizeof(best));
}

} // namespace

std::uint64_t
MedialVoxelRowPass::GetBytes(const std::int64_t length)
{
  return 2 * sizeof(double) * static_cast<std::uint64_t>(2 * (length + BlockSize) + 1);
}

void
MedialVoxelRowPass::SetLongestRow(const std::int64_t length)
{
  if (length <= m_Longest)
  {
    return;
  }
  m_Longest = length;
  const std::int64_t last = length + BlockSize;
  m_Steps.clear();
  m_Steps.reserve(static_cast<std::size_t>(2 * last + 1));
  for (std::int64_t step = -last; step <= last; ++step)
  {
    const bool   isReached = step >= -MedialVoxelSiteKey::LongestReach && step <= MedialVoxelSiteKey::LongestReach;
    const double along =
      m_Axis == Axis::X ? MedialVoxelSiteKey::StepAlongX(step) : MedialVoxelSiteKey::StepAlongY(step);
    m_Steps.push_back(isReached ? along : MedialVoxelSiteKey::NoSite);
  }
  m_BackwardSteps.assign(m_Steps.rbegin(), m_Steps.rend());
}

void
MedialVoxelRowPass::Search(const double * const       keys,
                           const std::int64_t         length,
                           const std::int64_t         first,
                           const std::int64_t         blocks,
                           const std::uint8_t * const needed,
                           double * const             result) const
{
  constexpr std::int64_t reach = MedialVoxelSiteKey::LongestReach;
  std::int64_t           lowest = 0;  // winner of the last voxel that has one
  std::int64_t           winner = -1; // of the first voxel of the block
  for (std::int64_t block = 0; block < blocks; ++block)
  {
    if (!needed[block])
    {
      continue;
    }
    const std::int64_t begin = first + block * BlockSize;
    if (block == 0 || !needed[block - 1])
    {
      winner = this->FindWinner(keys, length, begin, lowest);
      lowest = std::max(lowest, winner);
    }
    const bool         isContinued = block + 1 < blocks && needed[block + 1];
    const std::int64_t last = std::min(isContinued ? begin + BlockSize : begin + BlockSize - 1, length - 1);
    const std::int64_t nextWinner = this->FindWinner(keys, length, last, lowest);
    const std::int64_t from = winner >= 0 ? winner : std::max(lowest, begin - reach);
    const std::int64_t to = nextWinner >= 0 ? nextWinner : std::min(length - 1, last + reach);
    // Steps of the block's voxels stand next to each other when they are counted backwards.
    const double * const steps = m_BackwardSteps.data() + m_Longest + BlockSize + begin;
    MedialVoxelKernel<FindSmallestSums>::Run(keys, steps, from, to + 1, result + block * BlockSize);
    lowest = std::max(lowest, nextWinner);
    winner = nextWinner;
  }
}

std::int64_t
MedialVoxelRowPass::FindWinner(const double * const keys,
                               const std::int64_t   length,
                               const std::int64_t   center,
                               const std::int64_t   lowest) const
{
  constexpr std::int64_t longest = MedialVoxelSiteKey::LongestReach;
  const double * const   steps = m_Steps.data() + m_Longest + BlockSize;
  const auto             winnerOf = [&](const double key) {
    return center + (m_Axis == Axis::X ? MedialVoxelSiteKey::Decode(key).dx : MedialVoxelSiteKey::DecodeY(key));
  };
  const auto search = [&](const std::int64_t reach) {
    return MedialVoxelKernel<FindSmallestSum>::Run(
      keys, steps - center, std::max(lowest, center - reach), std::min(length, center + reach + 1));
  };

  // Any key bounds how far a better one can be.
  double key = std::min(keys[center], keys[lowest] + steps[lowest - center]);
  for (std::int64_t reach = FirstReach; !(key < MedialVoxelSiteKey::NoSite); reach *= 2)
  {
    key = search(reach);
    if (reach >= std::min(length, longest))
    {
      break;
    }
  }
  if (!(key < MedialVoxelSiteKey::NoSite))
  {
    return -1;
  }
  key = search(MedialVoxelSiteKey::ReachOf(key));
  return MedialVoxelSiteKey::ReachOf(key) <= longest ? winnerOf(key) : -1;
}

} // end namespace itk
