// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSparseBits.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelBox;
using itk::MedialVoxelIndex;
using itk::MedialVoxelSparseBits;

using Voxels = std::set<MedialVoxelIndex>;

const MedialVoxelIndex Size{ { 700, 6, 5 } };

class Random
{
public:
  explicit Random(const unsigned int seed)
    : m_Engine(seed)
  {}

  std::int64_t
  Below(const std::int64_t end)
  {
    return std::uniform_int_distribution<std::int64_t>(0, end - 1)(m_Engine);
  }

  MedialVoxelIndex
  IndexIn(const MedialVoxelBox & box)
  {
    MedialVoxelIndex index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = box.lower[axis] + this->Below(box.Extent(axis));
    }
    return index;
  }

  /** Of at least one voxel; half of them have all of the rows and slices. */
  MedialVoxelBox
  Box()
  {
    MedialVoxelBox box{ {}, Size };
    for (unsigned int axis = this->Below(2) == 0 ? 2 : 0; axis < 3; ++axis)
    {
      box.lower[axis] = this->Below(Size[axis]);
      box.upper[axis] = box.lower[axis] + 1 + this->Below(Size[axis] - box.lower[axis]);
    }
    return box;
  }

private:
  std::mt19937 m_Engine;
};

void
InvertSome(Random & random, MedialVoxelSparseBits & bits, Voxels & voxels)
{
  for (std::int64_t i = random.Below(3) == 0 ? 0 : random.Below(400); i > 0; --i)
  {
    const MedialVoxelIndex index = random.IndexIn(bits.GetBox());
    bits.Invert(index);
    if (voxels.erase(index) == 0)
    {
      voxels.insert(index);
    }
  }
}

Voxels
Within(const MedialVoxelBox & box, const Voxels & voxels)
{
  Voxels within;
  for (const MedialVoxelIndex & index : voxels)
  {
    if (box.Contains(index))
    {
      within.insert(index);
    }
  }
  return within;
}

Voxels
VoxelsOf(const MedialVoxelSparseBits & bits, const MedialVoxelBox & box)
{
  Voxels voxels;
  bits.VisitWords(box, [&](std::uint64_t rest, const std::int64_t word, const std::int64_t y, const std::int64_t z) {
    EXPECT_NE(rest, 0u);
    for (; rest != 0; rest &= rest - 1)
    {
      EXPECT_TRUE(voxels.insert(MedialVoxelIndex{ { word * 64 + itk::MedialVoxelLowestBit(rest), y, z } }).second);
    }
  });
  return voxels;
}
} // namespace

TEST(MedialVoxelSparseBits, HaveWhatASetOfVoxelsHas)
{
  Random                random(41);
  MedialVoxelSparseBits bits(random.Box());
  MedialVoxelSparseBits other(random.Box());
  Voxels                voxels;
  Voxels                otherVoxels;
  for (int step = 0; step < 600; ++step)
  {
    InvertSome(random, bits, voxels);
    const MedialVoxelBox box = random.Box();
    if (random.Below(2) == 0)
    {
      bits.Reframe(box);
      voxels = Within(box, voxels);
    }
    else
    {
      other.CopyFrom(bits, box);
      otherVoxels = Within(box, voxels);
      std::swap(bits, other);
      std::swap(voxels, otherVoxels);
    }
    ASSERT_EQ(bits.GetBox(), box) << step;
    ASSERT_EQ(VoxelsOf(bits, box), voxels) << step;
    const MedialVoxelBox part = random.Box();
    ASSERT_EQ(VoxelsOf(bits, part), Within(part, voxels)) << step;
    const MedialVoxelIndex index = random.IndexIn({ {}, Size });
    ASSERT_EQ(bits.Test(index), voxels.count(index) != 0) << step;
    ASSERT_LE(bits.GetReservedBytes(), MedialVoxelSparseBits::GetBytes(box)) << step;
  }
}

TEST(MedialVoxelSparseBits, TakeNoMoreThanPlannedWhenAllAreSet)
{
  const MedialVoxelBox  box{ { { 3, 1, 1 } }, Size };
  MedialVoxelSparseBits bits(box);
  ForEachVoxel(box, [&bits](const MedialVoxelIndex & index) { bits.Invert(index); });
  EXPECT_EQ(VoxelsOf(bits, box).size(), static_cast<std::size_t>(box.NumberOfVoxels()));
  EXPECT_LE(bits.GetReservedBytes(), MedialVoxelSparseBits::GetBytes(box));
}

TEST(MedialVoxelSparseBits, ZerosTakeNearlyNothing)
{
  const MedialVoxelBox  box{ {}, { { 4096, 512, 64 } } };
  MedialVoxelSparseBits bits(box);
  EXPECT_LT(bits.GetReservedBytes(), 8192u);
  bits.Invert({ { 4095, 511, 63 } });
  EXPECT_LT(bits.GetReservedBytes(), 65536u);
  EXPECT_GT(MedialVoxelSparseBits::GetBytes(box), itk::MedialVoxelBits::GetBytes(box) / 2);
}
