// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRowPass.h"

#include <algorithm>
#include <array>

namespace itk
{

namespace
{

/** Keys that are compared at once in the search for one voxel. */
constexpr std::int64_t Lanes = 8;

/** First attempt of a search about which nothing is known. */
constexpr std::int64_t FirstReach = 16;

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
  m_Steps.clear();
  const std::int64_t last = length + BlockSize;
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
    this->SearchBlock(keys, from, to + 1, begin, result + block * BlockSize);
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
  // Any key bounds how far a better one can be.
  const double known = std::min(keys[center], keys[lowest] + steps[lowest - center]);
  std::int64_t reach = known < MedialVoxelSiteKey::NoSite ? MedialVoxelSiteKey::ReachOf(known) : FirstReach;
  for (;;)
  {
    const std::int64_t begin = std::max(lowest, center - reach);
    const std::int64_t end = std::min(length, center + reach + 1);
    const double       key = this->SmallestKey(keys, begin, end, center);
    const bool         isWhole = begin == lowest && end == length;
    const std::int64_t found =
      key < MedialVoxelSiteKey::NoSite ? MedialVoxelSiteKey::ReachOf(key) : std::numeric_limits<std::int64_t>::max();
    if (found <= longest && (found <= reach || isWhole))
    {
      const MedialVoxelSiteKey site = MedialVoxelSiteKey::Decode(key);
      return center + (m_Axis == Axis::X ? site.dx : site.dy);
    }
    if (reach >= longest || isWhole)
    {
      return -1;
    }
    reach = std::min(found, 2 * reach);
  }
}

double
MedialVoxelRowPass::SmallestKey(const double * const keys,
                                const std::int64_t   begin,
                                const std::int64_t   end,
                                const std::int64_t   center) const
{
  const double * const      steps = m_Steps.data() + m_Longest + BlockSize - center;
  std::array<double, Lanes> smallest;
  smallest.fill(MedialVoxelSiteKey::NoSite);
  std::int64_t j = begin;
  for (; j + Lanes <= end; j += Lanes)
  {
    for (std::int64_t lane = 0; lane < Lanes; ++lane)
    {
      const double key = keys[j + lane] + steps[j + lane];
      double &     best = smallest[static_cast<std::size_t>(lane)];
      best = key < best ? key : best;
    }
  }
  for (; j < end; ++j)
  {
    smallest[0] = std::min(smallest[0], keys[j] + steps[j]);
  }
  return *std::min_element(smallest.begin(), smallest.end());
}

void
MedialVoxelRowPass::SearchBlock(const double * const keys,
                                const std::int64_t   begin,
                                const std::int64_t   end,
                                const std::int64_t   first,
                                double * const       result) const
{
  std::array<double, BlockSize> smallest;
  smallest.fill(MedialVoxelSiteKey::NoSite);
  // Steps of the block's voxels stand next to each other when they are counted backwards.
  const double * const steps = m_BackwardSteps.data() + m_Longest + BlockSize + first;
  for (std::int64_t j = begin; j < end; ++j)
  {
    const double         key = keys[j];
    const double * const step = steps - j;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(BlockSize); ++lane)
    {
      const double candidate = key + step[lane];
      smallest[lane] = candidate < smallest[lane] ? candidate : smallest[lane];
    }
  }
  std::copy(smallest.begin(), smallest.end(), result);
}

} // end namespace itk
