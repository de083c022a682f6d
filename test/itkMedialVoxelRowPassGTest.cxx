// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelRowPass.h"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

namespace
{
using itk::MedialVoxelRowPass;
using itk::MedialVoxelSiteKey;

constexpr std::int64_t Longest = MedialVoxelSiteKey::LongestReach;

double
KeyOf(std::int64_t dx, std::int64_t dy, std::int64_t dz)
{
  return MedialVoxelSiteKey::AlongZ(static_cast<double>(dz)) + MedialVoxelSiteKey::StepAlongY(dy) +
         MedialVoxelSiteKey::StepAlongX(dx);
}

std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>
OrderOf(std::int64_t dx, std::int64_t dy, std::int64_t dz)
{
  return { dx * dx + dy * dy + dz * dz, dz, dy, dx };
}

/** A row of keys as the pass before leaves them; one voxel in `gap` has a site. */
std::vector<double>
RandomRow(MedialVoxelRowPass::Axis axis,
          std::int64_t             length,
          unsigned int             gap,
          std::int64_t             reach,
          std::mt19937 &           random)
{
  const auto          any = [&] { return static_cast<std::int64_t>(random() % (2 * reach + 1)) - reach; };
  std::vector<double> keys;
  for (std::int64_t i = 0; i < length; ++i)
  {
    const std::int64_t dy = axis == MedialVoxelRowPass::Axis::X ? any() : 0;
    keys.push_back(random() % gap == 0 ? KeyOf(0, dy, any()) : MedialVoxelSiteKey::NoSite);
  }
  return keys;
}

double
SmallestKey(MedialVoxelRowPass::Axis axis, const std::vector<double> & keys, std::int64_t center)
{
  double smallest = MedialVoxelSiteKey::NoSite;
  for (std::int64_t j = 0; j < static_cast<std::int64_t>(keys.size()); ++j)
  {
    if (std::abs(j - center) <= Longest)
    {
      const double step = axis == MedialVoxelRowPass::Axis::X ? MedialVoxelSiteKey::StepAlongX(j - center)
                                                              : MedialVoxelSiteKey::StepAlongY(j - center);
      smallest = std::min(smallest, keys[static_cast<std::size_t>(j)] + step);
    }
  }
  return smallest;
}

/** How many voxels of the blocks from `first` on have another key than brute force, or one although not asked for. */
int
Differences(MedialVoxelRowPass &              pass,
            MedialVoxelRowPass::Axis          axis,
            const std::vector<double> &       keys,
            std::int64_t                      first,
            const std::vector<std::uint8_t> & needed)
{
  constexpr double    untouched = -1.0;
  constexpr double    longestKey = static_cast<double>(Longest * Longest + 1) * 134217728.0;
  std::vector<double> result(needed.size() * MedialVoxelRowPass::BlockSize, untouched);
  const auto          length = static_cast<std::int64_t>(keys.size());
  pass.SetLongestRow(length);
  pass.Search(keys.data(), length, first, static_cast<std::int64_t>(needed.size()), needed.data(), result.data());
  int differences = 0;
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    const std::int64_t center = first + static_cast<std::int64_t>(i);
    if (!needed[i / MedialVoxelRowPass::BlockSize])
    {
      differences += result[i] != untouched ? 1 : 0;
    }
    else if (center < length)
    {
      const double expected = SmallestKey(axis, keys, center);
      differences += (expected < longestKey ? result[i] != expected : result[i] < expected) ? 1 : 0;
    }
  }
  return differences;
}
} // namespace

TEST(MedialVoxelSiteKey, KeysHoldTheDisplacement)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 200000; ++trial)
  {
    const std::int64_t reach = trial % 3 == 0 ? 2 : (trial % 3 == 1 ? 120 : Longest);
    std::int64_t       d[3];
    for (std::int64_t & component : d)
    {
      component = static_cast<std::int64_t>(random() % (2 * reach + 1)) - reach;
      component = random() % 16 == 0 ? (component < 0 ? -reach : reach) : component;
    }
    const auto site = MedialVoxelSiteKey::Decode(KeyOf(d[0], d[1], d[2]));
    ASSERT_EQ(std::make_tuple(site.dx, site.dy, site.dz), std::make_tuple(d[0], d[1], d[2]));
    ASSERT_EQ(site.squaredLength, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    ASSERT_EQ(MedialVoxelSiteKey::DecodeY(KeyOf(d[0], d[1], d[2])), d[1]);
    const std::int64_t above = MedialVoxelSiteKey::ReachOf(KeyOf(d[0], d[1], d[2]));
    ASSERT_TRUE(above * above > site.squaredLength && (above - 1) * (above - 1) <= site.squaredLength);
  }
}

TEST(MedialVoxelSiteKey, KeysAreInTheOrderOfLengthZYX)
{
  for (int code = 0; code < 343 * 343; ++code)
  {
    const auto part = [](int number, int divisor) { return static_cast<std::int64_t>(number / divisor % 7 - 3); };
    const int  a = code % 343;
    const int  b = code / 343;
    ASSERT_EQ(KeyOf(part(a, 1), part(a, 7), part(a, 49)) < KeyOf(part(b, 1), part(b, 7), part(b, 49)),
              OrderOf(part(a, 1), part(a, 7), part(a, 49)) < OrderOf(part(b, 1), part(b, 7), part(b, 49)));
  }
}

TEST(MedialVoxelRowPass, RowsAreBruteForce)
{
  std::mt19937 random(2);
  for (const auto axis : { MedialVoxelRowPass::Axis::X, MedialVoxelRowPass::Axis::Y })
  {
    MedialVoxelRowPass pass(axis); // one for all rows, of any length
    for (int trial = 0; trial < 3000; ++trial)
    {
      const auto length = static_cast<std::int64_t>(1 + random() % 200);
      const auto keys = RandomRow(axis, length, trial % 5 == 0 ? 80 : 1 + trial % 4, 1 + trial % 40, random);
      const auto first = static_cast<std::int64_t>(random() % static_cast<unsigned int>(length));
      std::vector<std::uint8_t> needed(static_cast<std::size_t>((length - first + 15) / 16));
      for (auto & flag : needed)
      {
        flag = random() % 3 == 0 ? 0 : 1;
      }
      ASSERT_EQ(Differences(pass, axis, keys, first, needed), 0) << "trial " << trial;
    }
  }
}

TEST(MedialVoxelRowPass, LongRowsAreBruteForceAsFarAsKeysReach)
{
  std::mt19937 random(3);
  for (const auto axis : { MedialVoxelRowPass::Axis::X, MedialVoxelRowPass::Axis::Y })
  {
    MedialVoxelRowPass pass(axis);
    for (const unsigned int gap : { 40u, 2000u, 1000000u })
    {
      for (const std::int64_t reach : { std::int64_t{ 9 }, Longest })
      {
        const auto keys = RandomRow(axis, 5000, gap, reach, random);
        EXPECT_EQ(Differences(pass, axis, keys, 0, std::vector<std::uint8_t>(313, 1)), 0) << gap << ' ' << reach;
      }
    }
  }
}
