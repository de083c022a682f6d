// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelMovingWindow.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

/** Serves object bits of a volume and remembers how often each voxel was asked for. */
class CountingSource : public itk::MedialVoxelObjectSource
{
public:
  explicit CountingSource(const Volume & volume)
    : m_Volume(volume)
    , m_Asked(volume.object.size(), 0)
  {}

  void
  Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
  {
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      ++m_Asked[m_Volume.Offset(OracleIndex(v))];
      EXPECT_FALSE(targets.object->Test(v));
      if (m_Volume.IsObject(OracleIndex(v)))
      {
        targets.object->Set(v);
      }
    });
  }

  int
  GetMost() const
  {
    return *std::max_element(m_Asked.begin(), m_Asked.end());
  }
  int
  GetAsked(const itk::MedialVoxelIndex & v) const
  {
    return m_Asked[m_Volume.Offset(OracleIndex(v))];
  }

private:
  const Volume &   m_Volume;
  std::vector<int> m_Asked;
};

const std::vector<itk::MedialVoxelBoundary> BothKinds{ itk::MedialVoxelBoundary::Background,
                                                       itk::MedialVoxelBoundary::Object };

/** Bytes that all bits of the window have. */
std::uint64_t
ReservedBytes(const itk::MedialVoxelMovingWindow & window)
{
  std::uint64_t bytes = window.GetObject().GetReservedBytes() + window.GetNotANumber().GetReservedBytes();
  for (const auto kind : BothKinds)
  {
    bytes += window.GetWindow(kind).sites->GetReservedBytes();
  }
  return bytes;
}

/** How many boundary bits of both kinds in the window differ from the definition. */
std::size_t
Differences(const itk::MedialVoxelMovingWindow & window, const Volume & volume, const itk::MedialVoxelBox & sites)
{
  std::size_t differences = 0;
  for (const auto kind : BothKinds)
  {
    const auto   side = kind == itk::MedialVoxelBoundary::Object ? BoundarySide::Object : BoundarySide::Background;
    const auto   expected = SiteBits(BoundarySites(volume, side), sites);
    const auto & actual = *window.GetWindow(kind).sites;
    EXPECT_TRUE(actual.GetBox().Contains(sites));
    ForEachVoxel(sites, [&](const itk::MedialVoxelIndex & v) { differences += actual.Test(v) != expected.Test(v); });
  }
  ForEachVoxel(sites, [&](const itk::MedialVoxelIndex & v) {
    differences += window.GetObject().Test(v) != volume.IsObject(OracleIndex(v));
  });
  return differences;
}
} // namespace

TEST(MedialVoxelMovingWindow, SubtractedBoxesCoverTheRestOnce)
{
  const Index3 size{ { 9, 8, 7 } };
  std::mt19937 generator(8);
  for (int trial = 0; trial < 200; ++trial)
  {
    const auto wanted = RandomBox(size, generator);
    const auto present = trial % 10 == 0 ? itk::MedialVoxelBox{} : RandomBox(size, generator);
    const auto parts = itk::MedialVoxelSubtractBox(wanted, present);
    ForEachVoxel(MakeBox({ { 0, 0, 0 } }, size), [&](const itk::MedialVoxelIndex & v) {
      int times = 0;
      for (const auto & part : parts)
      {
        times += part.Contains(v) ? 1 : 0;
      }
      ASSERT_EQ(times, wanted.Contains(v) && !present.Contains(v) ? 1 : 0);
    });
    for (const auto & part : parts)
    {
      EXPECT_FALSE(part.IsEmpty());
    }
  }
}

TEST(MedialVoxelMovingWindow, SlabsGrowByWholeSlices)
{
  const auto present = MakeBox({ { 0, 0, 0 } }, { { 9, 9, 4 } });
  const auto parts = itk::MedialVoxelSubtractBox(MakeBox({ { 0, 0, 0 } }, { { 9, 9, 7 } }), present);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0], MakeBox({ { 0, 0, 4 } }, { { 9, 9, 7 } }));
}

TEST(MedialVoxelMovingWindow, AMovingWindowAsksOnceForEachVoxel)
{
  const Volume                 volume = RandomBoxes({ { 70, 13, 60 } }, UnitSpacing, 20, 201);
  CountingSource               source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), BothKinds);
  for (int z = 0; z + 9 <= 60; z += 3)
  {
    const auto sites = MakeBox({ { 0, 0, z } }, { { 70, 13, z + 9 } });
    window.MoveTo(sites, sites, source);
    EXPECT_EQ(Differences(window, volume, sites), 0u) << "z " << z;
  }
  EXPECT_EQ(source.GetMost(), 1);
}

TEST(MedialVoxelMovingWindow, AGrowingWindowAsksForTheRestOnly)
{
  const Volume                 volume = RandomBoxes({ { 90, 30, 30 } }, UnitSpacing, 20, 202);
  CountingSource               source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), BothKinds);
  auto                         sites = MakeBox({ { 40, 14, 14 } }, { { 50, 16, 16 } });
  for (int step = 0; step < 6; ++step)
  {
    window.MoveTo(sites, sites, source);
    EXPECT_EQ(Differences(window, volume, sites), 0u) << "step " << step;
    sites = sites.Expanded({ { 7, 2, 2 } }).Intersection(GridOf(volume).GetVoxelBox());
  }
  EXPECT_EQ(source.GetMost(), 1);
  const auto asked = window.GetObjectBox(window.GetWindow(itk::MedialVoxelBoundary::Object).sites->GetBox());
  ForEachVoxel(GridOf(volume).GetVoxelBox(),
               [&](const itk::MedialVoxelIndex & v) { ASSERT_EQ(source.GetAsked(v), asked.Contains(v) ? 1 : 0); });
}

TEST(MedialVoxelMovingWindow, AWindowMayJump)
{
  const Volume                 volume = RandomBoxes({ { 70, 20, 20 } }, UnitSpacing, 15, 203);
  CountingSource               source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), BothKinds);
  std::mt19937                 generator(9);
  for (int trial = 0; trial < 25; ++trial)
  {
    const auto sites = RandomBox(volume.size, generator);
    window.MoveTo(sites, sites, source);
    EXPECT_EQ(Differences(window, volume, sites), 0u) << trial;
  }
}

TEST(MedialVoxelMovingWindow, AMoveTakesNoMoreThanItSays)
{
  const Volume                 volume = RandomBoxes({ { 70, 20, 30 } }, UnitSpacing, 15, 204);
  CountingSource               source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), BothKinds);
  std::mt19937                 generator(10);
  for (int trial = 0; trial < 50; ++trial)
  {
    // Slabs, which move in place, and boxes, which are copied.
    auto sites = RandomBox(volume.size, generator);
    if (trial % 2 == 0)
    {
      sites = MakeBox({ { 0, 0, int(sites.lower[2]) } }, { { 70, 20, int(sites.upper[2]) } });
    }
    const auto          largestSites = RandomBox(volume.size, generator);
    const std::uint64_t allowed = window.GetBytesToReframe(sites, largestSites);
    window.MoveTo(sites, largestSites, source);
    EXPECT_LE(ReservedBytes(window), allowed) << trial;
    EXPECT_GE(allowed, window.GetBytes(sites));
  }
}

TEST(MedialVoxelMovingWindow, AWindowWithRoomGrowsInPlace)
{
  const Volume                 volume = RandomBoxes({ { 70, 20, 30 } }, UnitSpacing, 15, 206);
  CountingSource               source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), BothKinds);
  const auto                   largestSites = MakeBox({ { 0, 0, 10 } }, { { 70, 20, 20 } });
  window.MoveTo(MakeBox({ { 0, 0, 0 } }, { { 70, 20, 4 } }), largestSites, source);
  const std::uint64_t bytes = ReservedBytes(window);
  const auto          sites = MakeBox({ { 0, 0, 1 } }, { { 70, 20, 11 } });
  EXPECT_EQ(window.GetBytesToReframe(sites, largestSites), bytes);
  window.MoveTo(sites, largestSites, source);
  EXPECT_EQ(ReservedBytes(window), bytes);
  EXPECT_EQ(Differences(window, volume, sites), 0u);
}

TEST(MedialVoxelMovingWindow, AClearedWindowHasNoMemory)
{
  const Volume                 volume = RandomBoxes({ { 70, 20, 30 } }, UnitSpacing, 15, 205);
  CountingSource               source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), BothKinds, true);
  const auto                   sites = MakeBox({ { 0, 0, 4 } }, { { 70, 20, 9 } });
  window.MoveTo(sites, sites, source);
  EXPECT_GE(ReservedBytes(window), window.GetBytes(sites));
  window.Clear();
  EXPECT_EQ(ReservedBytes(window), 0u);
  EXPECT_EQ(window.GetBytesToReframe(sites, sites), window.GetBytes(sites));
  window.MoveTo(sites, sites, source);
  EXPECT_EQ(Differences(window, volume, sites), 0u);
}

TEST(MedialVoxelMovingWindow, BoundariesNeedOneMoreVoxelWithinTheImage)
{
  const Volume                       volume({ { 30, 1, 20 } }, UnitSpacing);
  const itk::MedialVoxelMovingWindow window(GridOf(volume), BothKinds);
  EXPECT_EQ(window.GetObjectBox(MakeBox({ { 4, 0, 5 } }, { { 8, 1, 20 } })),
            MakeBox({ { 3, 0, 4 } }, { { 9, 1, 20 } }));
}

TEST(MedialVoxelMovingWindow, OnlyListedBoundariesAreKept)
{
  const Volume                       volume({ { 30, 10, 20 } }, UnitSpacing);
  const itk::MedialVoxelMovingWindow window(GridOf(volume), { itk::MedialVoxelBoundary::Object });
  EXPECT_NO_THROW(window.GetWindow(itk::MedialVoxelBoundary::Object));
  EXPECT_THROW(window.GetWindow(itk::MedialVoxelBoundary::Background), std::invalid_argument);
}

TEST(MedialVoxelMovingWindow, KeepsValuesWithTheObject)
{
  class GraySource : public CountingSource
  {
  public:
    using CountingSource::CountingSource;
    void
    Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
    {
      CountingSource::Fill(box, targets);
      ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
        targets.gray->GetRow(v[1], v[2])[v[0] - targets.gray->GetBox().lower[0]] =
          static_cast<float>(v[0] + 100 * v[1] + 10000 * v[2]);
      });
    }
  };
  const Volume                 volume = RandomVolume({ { 70, 20, 40 } }, UnitSpacing, 0.5, 31);
  const itk::MedialVoxelGrid   grid = GridOf(volume);
  GraySource                   source(volume);
  itk::MedialVoxelMovingWindow window(grid, BothKinds, false, true);
  itk::MedialVoxelMovingWindow bits(grid, BothKinds);
  for (const auto & sites : { MakeBox({ { 0, 0, 0 } }, { { 70, 20, 9 } }),
                              MakeBox({ { 0, 0, 5 } }, { { 70, 20, 16 } }),
                              MakeBox({ { 3, 2, 14 } }, { { 60, 19, 33 } }),
                              MakeBox({ { 0, 0, 30 } }, { { 70, 20, 40 } }) })
  {
    const itk::MedialVoxelBox objectBox = window.GetObjectBox(sites);
    EXPECT_EQ(window.GetBytes(sites), bits.GetBytes(sites) + itk::MedialVoxelGray::GetBytes(objectBox));
    EXPECT_GE(window.GetBytesToReframe(sites, sites), window.GetBytes(sites));
    window.MoveTo(sites, sites, source);
    EXPECT_EQ(window.GetGray().GetBox().lower, objectBox.lower);
    EXPECT_EQ(window.GetGray().GetBox().upper, objectBox.upper);
    ForEachVoxel(objectBox, [&](const itk::MedialVoxelIndex & v) {
      ASSERT_EQ(window.GetGray().Get(v), static_cast<float>(v[0] + 100 * v[1] + 10000 * v[2]));
    });
  }
  window.Clear();
  EXPECT_TRUE(window.GetGray().GetBox().IsEmpty());
}
