// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelBits.h"

#include "itkMedialVoxelDilation.h"
#include "itkMedialVoxelObjectPredicate.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelBits;

const Index3 Size{ { 203, 4, 3 } };
} // namespace

TEST(MedialVoxelBits, KeepWhatIsSetInAnyBox)
{
  const Volume volume = RandomVolume(Size, UnitSpacing, 0.4, 131);
  for (const auto & box : { MakeBox({ { 0, 0, 0 } }, Size),
                            MakeBox({ { 64, 1, 1 } }, { { 128, 3, 2 } }),
                            MakeBox({ { 63, 0, 1 } }, { { 65, 4, 3 } }),
                            MakeBox({ { 130, 2, 0 } }, { { 201, 4, 3 } }),
                            MakeBox({ { 7, 3, 2 } }, { { 8, 4, 3 } }) })
  {
    const MedialVoxelBits bits = ObjectBits(volume, box);
    EXPECT_EQ(bits.GetBox(), box);
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < volume.object.size(); ++i)
    {
      const auto index = KernelIndex(volume.IndexAt(i));
      const bool expected = box.Contains(index) && volume.object[i];
      ASSERT_EQ(bits.Test(index), expected) << i;
      count += expected ? 1 : 0;
    }
    EXPECT_EQ(bits.Count(box), count);
    EXPECT_EQ(bits.Count(MakeBox({ { 0, 0, 0 } }, Size)), count);
  }
}

TEST(MedialVoxelBits, OutsideTheBoxAllIsZero)
{
  const MedialVoxelBits bits =
    ObjectBits(Complement(Volume(Size, UnitSpacing)), MakeBox({ { 70, 1, 1 } }, { { 90, 3, 2 } }));
  for (const Index3 & outside : { Index3{ { 69, 1, 1 } },
                                  Index3{ { 90, 1, 1 } },
                                  Index3{ { 80, 0, 1 } },
                                  Index3{ { 80, 3, 1 } },
                                  Index3{ { 80, 1, 0 } },
                                  Index3{ { 80, 1, 2 } },
                                  Index3{ { -1, -1, -1 } } })
  {
    EXPECT_FALSE(bits.Test(KernelIndex(outside)));
  }
  EXPECT_EQ(bits.GetRow(1, 1)[-1], 0u);
  EXPECT_EQ(bits.GetRow(2, 1)[bits.GetWordsPerRow()], 0u);
  EXPECT_TRUE(bits.HasRow(1, 1) && bits.HasRow(2, 1));
  EXPECT_FALSE(bits.HasRow(0, 1) || bits.HasRow(3, 1) || bits.HasRow(1, 0) || bits.HasRow(1, 2));
  EXPECT_EQ(bits.GetFirstWord(), 1);
}

TEST(MedialVoxelBits, WordsLineUpWithTheImage)
{
  MedialVoxelBits bits(MakeBox({ { 70, 0, 0 } }, { { 140, 1, 1 } }));
  bits.Set({ { 70, 0, 0 } });
  bits.Set({ { 128, 0, 0 } });
  EXPECT_EQ(bits.GetFirstWord(), 1);
  EXPECT_EQ(bits.GetWordsPerRow(), 2);
  EXPECT_EQ(bits.GetRow(0, 0)[0], std::uint64_t{ 1 } << 6);
  EXPECT_EQ(bits.GetRow(0, 0)[1], std::uint64_t{ 1 });
}

TEST(MedialVoxelBits, ExtractReadsFromAnyVoxel)
{
  const Volume          volume = RandomVolume(Size, UnitSpacing, 0.5, 132);
  const auto            box = MakeBox({ { 5, 0, 0 } }, { { 199, 4, 3 } });
  const MedialVoxelBits bits = ObjectBits(volume, box);
  for (int x = -70; x < 270; ++x)
  {
    const auto word = bits.Extract(x, 2, 1);
    for (int bit = 0; bit < 64; ++bit)
    {
      const Index3 v{ { x + bit, 2, 1 } };
      const bool   expected = box.Contains(KernelIndex(v)) && volume.IsObject(v);
      ASSERT_EQ((word >> bit & 1) != 0, expected) << "x " << x << ", bit " << bit;
    }
  }
}

TEST(MedialVoxelBits, RangeMasksHoldTheRange)
{
  for (int lower = 0; lower < 200; lower += 7)
  {
    for (int upper = lower; upper < 210; upper += 5)
    {
      for (int word = 0; word < 4; ++word)
      {
        const auto mask = MedialVoxelBits::RangeMask(word, lower, upper);
        for (int bit = 0; bit < 64; ++bit)
        {
          const int x = 64 * word + bit;
          ASSERT_EQ((mask >> bit & 1) != 0, x >= lower && x < upper) << lower << ' ' << upper << ' ' << x;
        }
      }
    }
  }
}

TEST(MedialVoxelBits, ReframingKeepsWhatIsShared)
{
  const Volume volume = RandomVolume(Size, UnitSpacing, 0.5, 133);
  std::mt19937 generator(1);
  for (int trial = 0; trial < 40; ++trial)
  {
    const auto      from = RandomBox(Size, generator);
    const auto      to = RandomBox(Size, generator);
    MedialVoxelBits bits = ObjectBits(volume, from);
    bits.Reframe(to, RandomBox(Size, generator));
    EXPECT_EQ(bits.GetBox(), to);
    MedialVoxelBits expected(to);
    ForEachVoxel(from.Intersection(to), [&](const itk::MedialVoxelIndex & v) {
      if (volume.IsObject(OracleIndex(v)))
      {
        expected.Set(v);
      }
    });
    ASSERT_EQ(bits.GetWordsPerRow(), expected.GetWordsPerRow());
    for (auto z = to.lower[2]; z < to.upper[2]; ++z)
    {
      for (auto y = to.lower[1]; y < to.upper[1]; ++y)
      {
        for (std::int64_t word = -1; word <= bits.GetWordsPerRow(); ++word)
        {
          // Whole words, since bits outside the box are zero as well.
          ASSERT_EQ(bits.GetRow(y, z)[word], expected.GetRow(y, z)[word]);
        }
      }
    }
  }
}

TEST(MedialVoxelBits, ReshapingClears)
{
  MedialVoxelBits bits = ObjectBits(Complement(Volume(Size, UnitSpacing)), MakeBox({ { 0, 0, 0 } }, Size));
  bits.Reshape(MakeBox({ { 0, 0, 0 } }, { { 100, 2, 2 } }));
  EXPECT_EQ(bits.Count(bits.GetBox()), 0u);
}

TEST(MedialVoxelBits, CountsAndAnyAreClipped)
{
  const Volume volume = RandomVolume(Size, UnitSpacing, 0.02, 134);
  std::mt19937 generator(2);
  for (int trial = 0; trial < 200; ++trial)
  {
    const MedialVoxelBits bits = ObjectBits(volume, RandomBox(Size, generator));
    const auto            query = RandomBox(Size, generator);
    std::uint64_t         expected = 0;
    ForEachVoxel(query, [&](const itk::MedialVoxelIndex & v) { expected += bits.Test(v) ? 1 : 0; });
    ASSERT_EQ(bits.Count(query), expected);
    ASSERT_EQ(bits.Any(query), expected > 0);
  }
}

TEST(MedialVoxelBits, SingleWordsAreSearched)
{
  for (int bit = 0; bit < 64; ++bit)
  {
    const std::uint64_t word = std::uint64_t{ 1 } << bit;
    EXPECT_EQ(itk::MedialVoxelLowestBit(word), bit);
    EXPECT_EQ(itk::MedialVoxelHighestBit(word), bit);
    EXPECT_EQ(itk::MedialVoxelLowestBit(word | (word << 1)), bit);
    EXPECT_EQ(itk::MedialVoxelHighestBit(word | 1), bit);
    EXPECT_EQ(itk::MedialVoxelPopulationCount(word - 1), bit);
  }
  EXPECT_EQ(itk::MedialVoxelPopulationCount(~std::uint64_t{ 0 }), 64);
}

TEST(MedialVoxelBits, PixelsArePackedWhereTheyBelong)
{
  const Volume       row = RandomVolume({ { 200, 1, 1 } }, UnitSpacing, 0.5, 135);
  std::vector<short> pixels;
  for (const auto value : row.object)
  {
    pixels.push_back(value ? 500 : -500);
  }
  const auto predicate = itk::MedialVoxelObjectPredicate<short>::InRange(499.5, 600);
  for (const int first : { 0, 1, 63, 64, 65, 100 })
  {
    for (const int count : { 0, 1, 5, 63, 64, 65, 100 })
    {
      std::vector<std::uint64_t> words(4, 0);
      itk::MedialVoxelPackRow(pixels.data() + first, first, count, predicate, words.data());
      for (int x = 0; x < 200; ++x)
      {
        const bool expected = x >= first && x < first + count && row.object[x];
        ASSERT_EQ((words[x / 64] >> (x % 64) & 1) != 0, expected) << first << ' ' << count << ' ' << x;
      }
    }
  }
}

TEST(MedialVoxelBits, DilationFindsAllThatAreNear)
{
  const Volume volume = RandomVolume(Size, UnitSpacing, 0.02, 17);
  for (const auto & box : { MakeBox({ { 0, 0, 0 } }, Size), MakeBox({ { 61, 1, 0 } }, { { 193, 4, 2 } }) })
  {
    const MedialVoxelBits bits = ObjectBits(volume, box);
    for (const std::int64_t reach : { 1, 2, 5, 63 })
    {
      const MedialVoxelBits near = itk::MedialVoxelDilate(bits, reach);
      for (std::size_t i = 0; i < volume.object.size(); ++i)
      {
        const auto                index = KernelIndex(volume.IndexAt(i));
        const itk::MedialVoxelBox own{ index, { { index[0] + 1, index[1] + 1, index[2] + 1 } } };
        if (box.Contains(index))
        {
          ASSERT_EQ(near.Test(index), bits.Any(own.Expanded({ { reach, reach, reach } }))) << i << ", " << reach;
        }
      }
    }
  }
}
