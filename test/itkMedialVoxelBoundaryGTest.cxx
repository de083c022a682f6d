// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelBoundary.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

/** The boundary of every box of a volume, known from its object bits and a margin of one voxel. */
void
ExpectOracleBoundary(const Volume & volume, const itk::MedialVoxelBox & box)
{
  const auto image = GridOf(volume).GetVoxelBox();
  const auto known = box.Expanded(KernelIndex({ { 1, 1, 1 } })).Intersection(image);
  for (const BoundarySide side : { BoundarySide::Background, BoundarySide::Object })
  {
    const auto           expected = SiteBits(BoundarySites(volume, side), box);
    itk::MedialVoxelBits actual(box);
    itk::MedialVoxelComputeBoundary(ObjectBits(volume, known),
                                    image,
                                    side == BoundarySide::Object ? itk::MedialVoxelBoundary::Object
                                                                 : itk::MedialVoxelBoundary::Background,
                                    box,
                                    actual);
    std::size_t differences = 0;
    ForEachVoxel(image, [&](const itk::MedialVoxelIndex & v) { differences += actual.Test(v) != expected.Test(v); });
    EXPECT_EQ(differences, 0u);
  }
}
} // namespace

TEST(MedialVoxelBoundary, IsTheDefinitionInWholeVolumes)
{
  for (const Index3 & size : { Index3{ { 131, 7, 6 } },
                               Index3{ { 64, 5, 5 } },
                               Index3{ { 65, 9, 1 } },
                               Index3{ { 1, 9, 8 } },
                               Index3{ { 130, 1, 1 } },
                               Index3{ { 1, 1, 1 } } })
  {
    for (const double density : { 0.02, 0.5, 0.98 })
    {
      const Volume volume = RandomVolume(size, UnitSpacing, density, 141);
      ExpectOracleBoundary(volume, GridOf(volume).GetVoxelBox());
    }
  }
}

TEST(MedialVoxelBoundary, IsTheDefinitionInAnyBox)
{
  std::mt19937 generator(3);
  const Volume volume = RandomVolume({ { 140, 9, 8 } }, UnitSpacing, 0.9, 142);
  for (int trial = 0; trial < 60; ++trial)
  {
    ExpectOracleBoundary(volume, RandomBox(volume.size, generator));
  }
}

TEST(MedialVoxelBoundary, EveryNeighborCounts)
{
  for (int position = 0; position < 27; ++position)
  {
    Volume volume({ { 3, 3, 3 } }, UnitSpacing);
    volume.Set({ { position % 3, position / 3 % 3, position / 9 } }, true);
    ExpectOracleBoundary(volume, GridOf(volume).GetVoxelBox());
    ExpectOracleBoundary(Complement(volume), GridOf(volume).GetVoxelBox());
  }
}

TEST(MedialVoxelBoundary, WordBordersAreNoBarrier)
{
  for (const int x : { 62, 63, 64, 65, 127, 128 })
  {
    Volume volume({ { 192, 3, 3 } }, UnitSpacing);
    volume.Set({ { x, 1, 1 } }, true);
    ExpectOracleBoundary(volume, GridOf(volume).GetVoxelBox());
    ExpectOracleBoundary(Complement(volume), GridOf(volume).GetVoxelBox());
  }
}
