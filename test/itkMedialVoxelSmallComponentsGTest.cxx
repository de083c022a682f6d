// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Pores and dust in the bits of a window: against components of the whole volume, for windows of any kind.

#include "itkMedialVoxelMovingWindow.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSmallComponents.h"

#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestPores.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

const std::vector<itk::MedialVoxelBoundary> Background{ itk::MedialVoxelBoundary::Background };

/** Serves object bits of a volume and counts the voxels that it was asked for. */
class VolumeSource : public itk::MedialVoxelObjectSource
{
public:
  explicit VolumeSource(const Volume & volume)
    : m_Volume(volume)
  {}

  void
  Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
  {
    m_AskedVoxels += box.NumberOfVoxels();
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      EXPECT_FALSE(targets.object->Test(v));
      if (m_Volume.IsObject(OracleIndex(v)))
      {
        targets.object->Set(v);
      }
    });
  }

  std::int64_t
  GetAskedVoxels() const
  {
    return m_AskedVoxels;
  }

private:
  const Volume & m_Volume;
  std::int64_t   m_AskedVoxels{ 0 };
};

/** The object of a whole volume after the change, by the kernel. */
Volume
Changed(const Volume & volume, std::uint64_t most)
{
  const itk::MedialVoxelGrid            grid = GridOf(volume);
  const itk::MedialVoxelSmallComponents kernel(grid, most);
  auto                                  object = ObjectBits(volume, grid.GetVoxelBox());
  itk::MedialVoxelSparseBits            changed(grid.GetVoxelBox());
  kernel.Change(grid.GetVoxelBox(), object, changed);
  Volume result = volume;
  for (std::size_t i = 0; i < result.object.size(); ++i)
  {
    const auto index = KernelIndex(volume.IndexAt(i));
    result.object[i] = object.Test(index) ? 1 : 0;
    EXPECT_EQ(changed.Test(index), result.object[i] != volume.object[i]);
  }
  return result;
}

/** Wrong bits in the sites of a window and one voxel around them, and wrong counts. */
std::size_t
Differences(const itk::MedialVoxelMovingWindow & window,
            const itk::MedialVoxelBox &          sites,
            const Volume &                       volume,
            const Volume &                       expected)
{
  std::size_t differences = 0;
  ForEachVoxel(window.GetObjectBox(sites), [&](const itk::MedialVoxelIndex & v) {
    differences += window.GetObject().Test(v) != expected.IsObject(OracleIndex(v)) ? 1 : 0;
  });
  const auto     boundary = SiteBits(BoundarySites(expected), sites);
  std::ptrdiff_t filled = 0;
  std::ptrdiff_t removed = 0;
  ForEachVoxel(sites, [&](const itk::MedialVoxelIndex & v) {
    const bool was = volume.IsObject(OracleIndex(v));
    const bool is = expected.IsObject(OracleIndex(v));
    filled += is && !was ? 1 : 0;
    removed += was && !is ? 1 : 0;
    differences += window.GetWindow(Background[0]).sites->Test(v) != boundary.Test(v) ? 1 : 0;
  });
  const auto changes = window.CountChanges(sites);
  differences += changes.filled != static_cast<std::uint64_t>(filled) ? 1 : 0;
  differences += changes.removed != static_cast<std::uint64_t>(removed) ? 1 : 0;
  return differences;
}
/** Move a window, in parts, with what another one has. */
void
CopyAndMove(itk::MedialVoxelMovingWindow &       window,
            const itk::MedialVoxelBox &          sites,
            const itk::MedialVoxelMovingWindow & donor,
            VolumeSource &                       source)
{
  constexpr std::int64_t parts = 3;
  window.BeginMove(sites, sites, &donor);
  for (const itk::MedialVoxelBox & part : window.CutToFill(parts, 1))
  {
    window.Fill(part, source);
  }
  window.ChangeSmallComponents();
  for (const itk::MedialVoxelBox & part : window.CutToMark(parts))
  {
    window.Mark(part);
  }
}
} // namespace

TEST(MedialVoxelSmallComponents, RandomMasksFollowTheDefinition)
{
  unsigned int seed = 700;
  std::size_t  changes = 0;
  for (const Index3 & size : { Index3{ { 20, 17, 15 } },
                               Index3{ { 131, 9, 7 } },
                               Index3{ { 70, 40, 1 } },
                               Index3{ { 66, 1, 40 } },
                               Index3{ { 1, 40, 43 } },
                               Index3{ { 200, 1, 1 } },
                               Index3{ { 1, 200, 1 } },
                               Index3{ { 1, 1, 200 } },
                               Index3{ { 3, 3, 3 } },
                               Index3{ { 2, 2, 1 } },
                               Index3{ { 1, 1, 1 } } })
  {
    for (const double share : { 0.04, 0.09, 0.3, 0.7, 0.91, 0.96 })
    {
      const Volume volume = RandomVolume(size, UnitSpacing, share, ++seed);
      for (const std::size_t most : { 1u, 2u, 3u, 7u, 32u, 1000u })
      {
        const Volume expected = WithoutPores(volume, most);
        ASSERT_EQ(Changed(volume, most).object, expected.object) << "seed " << seed << ", at most " << most;
        changes += expected.object != volume.object ? 1 : 0;
      }
      ASSERT_EQ(Changed(volume, 1000000).object, WithoutPores(volume, 1000000).object);
    }
  }
  EXPECT_GT(changes, 150u);
}

TEST(MedialVoxelSmallComponents, NoneIsChangedWithoutASize)
{
  const itk::MedialVoxelGrid grid({ { 20, 10, 1 } }, UnitSpacing);
  EXPECT_FALSE(itk::MedialVoxelSmallComponents(grid, 0).IsOn());
  EXPECT_EQ(itk::MedialVoxelSmallComponents(grid, 0).GetMargin(), (itk::MedialVoxelIndex{ { 0, 0, 0 } }));
  EXPECT_EQ(itk::MedialVoxelSmallComponents(grid, 9).GetMargin(), (itk::MedialVoxelIndex{ { 9, 9, 0 } }));
  const itk::MedialVoxelGrid row({ { 1, 30, 1 } }, UnitSpacing);
  EXPECT_EQ(itk::MedialVoxelSmallComponents(row, 9).GetMargin(), (itk::MedialVoxelIndex{ { 0, 18, 0 } }));
  const itk::MedialVoxelGrid voxel({ { 1, 1, 1 } }, UnitSpacing);
  EXPECT_FALSE(itk::MedialVoxelSmallComponents(voxel, 9).IsOn());
}

TEST(MedialVoxelSmallComponents, WhatTouchesAFaceStays)
{
  // A pore and a grain of one voxel, at each place of a small volume.
  for (const bool kind : { false, true })
  {
    for (int place = 0; place < 5 * 4 * 3; ++place)
    {
      Volume volume({ { 5, 4, 3 } }, UnitSpacing);
      std::fill(volume.object.begin(), volume.object.end(), kind ? 0 : 1);
      const Index3 v = volume.IndexAt(static_cast<std::size_t>(place));
      volume.Set(v, kind);
      const bool isInside = v[0] % 4 != 0 && v[1] % 3 != 0 && v[2] == 1;
      const auto result = Changed(volume, 1);
      EXPECT_EQ(result.IsObject(v), kind != isInside);
      EXPECT_EQ(VoxelsOnlyIn(volume, result) + VoxelsOnlyIn(result, volume), isInside ? 1u : 0u);
    }
  }
}

TEST(MedialVoxelSmallComponents, DiagonalNeighborsAreConnected)
{
  // A wall of one voxel and a gap of one voxel, tilted: no two of their voxels share a side.
  for (const bool kind : { false, true })
  {
    const Volume volume = MakeVolume({ { 12, 12, 1 } }, UnitSpacing, [&](const Index3 & v) {
      return (v[0] == v[1] && v[0] >= 2 && v[0] < 10) == kind;
    });
    EXPECT_EQ(Changed(volume, 7).object, volume.object);
    EXPECT_NE(Changed(volume, 8).object, volume.object);
  }
}

TEST(MedialVoxelSmallComponents, WindowsOfAnyKindHoldTheSameBits)
{
  unsigned int seed = 800;
  std::mt19937 generator(801);
  for (const Index3 & size : { Index3{ { 75, 22, 20 } },
                               Index3{ { 40, 44, 1 } },
                               Index3{ { 70, 1, 44 } },
                               Index3{ { 1, 40, 44 } },
                               Index3{ { 150, 1, 1 } },
                               Index3{ { 1, 1, 150 } } })
  {
    for (const int most : { 1, 2, 5, 9, 12, 26, 32, 60 })
    {
      const Volume                 volume = VolumeWithPores(size, UnitSpacing, most, ++seed);
      const Volume                 expected = WithoutPores(volume, static_cast<std::size_t>(most));
      VolumeSource                 source(volume);
      itk::MedialVoxelMovingWindow window(GridOf(volume), Background, false, false, static_cast<std::uint64_t>(most));
      itk::MedialVoxelMovingWindow ahead(GridOf(volume), Background, false, false, static_cast<std::uint64_t>(most));
      for (int trial = 0; trial < 12; ++trial)
      {
        auto sites = RandomBox(size, generator);
        for (int growth = 0; growth < 3; ++growth)
        {
          const std::uint64_t allowed = window.GetBytesToReframe(sites, sites);
          window.MoveTo(sites, sites, source);
          ASSERT_EQ(Differences(window, sites, volume, expected), 0u) << "seed " << seed << ", at most " << most;
          EXPECT_GE(allowed, window.GetBytes(sites));
          // On along the slowest axis, as slabs do, or in all directions.
          const itk::MedialVoxelIndex step =
            trial % 2 == 0 ? itk::MedialVoxelIndex{ { 0, 0, 2 } } : itk::MedialVoxelIndex{ { 3, 2, 1 } };
          sites = sites.Expanded(step).Intersection(GridOf(volume).GetVoxelBox());
          CopyAndMove(ahead, sites, window, source);
          ASSERT_EQ(Differences(ahead, sites, volume, expected), 0u) << "seed " << seed << ", at most " << most;
        }
      }
    }
  }
}

TEST(MedialVoxelSmallComponents, AMovingWindowAsksOnceForEachVoxel)
{
  const Volume                 volume = VolumeWithPores({ { 70, 13, 60 } }, UnitSpacing, 9, 830);
  const Volume                 expected = WithoutPores(volume, 9);
  VolumeSource                 source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), Background, false, false, 9);
  for (int z = 0; z + 4 <= 60; z += 4)
  {
    const auto sites = MakeBox({ { 0, 0, z } }, { { 70, 13, z + 4 } });
    EXPECT_EQ(window.GetInputBox(sites),
              MakeBox({ { 0, 0, std::max(0, z - 10) } }, { { 70, 13, std::min(60, z + 14) } }));
    window.MoveTo(sites, sites, source);
    EXPECT_EQ(Differences(window, sites, volume, expected), 0u) << "z " << z;
  }
  EXPECT_EQ(source.GetAskedVoxels(), static_cast<std::int64_t>(volume.object.size()));
}

TEST(MedialVoxelSmallComponents, ValuesDoNotReachFartherThanTheObject)
{
  class GraySource : public VolumeSource
  {
  public:
    using VolumeSource::VolumeSource;
    void
    Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
    {
      if (targets.gray == nullptr)
      {
        VolumeSource::Fill(box, targets);
        return;
      }
      ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
        targets.gray->GetRow(v[1], v[2])[v[0] - targets.gray->GetBox().lower[0]] =
          static_cast<float>(v[0] + 100 * v[1] + 10000 * v[2]);
      });
    }
  };
  const Volume                 volume = VolumeWithPores({ { 70, 20, 40 } }, UnitSpacing, 6, 840);
  const Volume                 expected = WithoutPores(volume, 6);
  GraySource                   source(volume);
  itk::MedialVoxelMovingWindow window(GridOf(volume), Background, false, true, 6);
  for (const auto & sites : { MakeBox({ { 0, 0, 0 } }, { { 70, 20, 9 } }),
                              MakeBox({ { 0, 0, 5 } }, { { 70, 20, 16 } }),
                              MakeBox({ { 3, 2, 14 } }, { { 60, 19, 33 } }) })
  {
    window.MoveTo(sites, sites, source);
    EXPECT_EQ(Differences(window, sites, volume, expected), 0u);
    EXPECT_EQ(window.GetGray().GetBox(), window.GetObjectBox(sites));
    ForEachVoxel(window.GetObjectBox(sites), [&](const itk::MedialVoxelIndex & v) {
      ASSERT_EQ(window.GetGray().Get(v), static_cast<float>(v[0] + 100 * v[1] + 10000 * v[2]));
    });
  }
}

TEST(MedialVoxelSmallComponents, ProgressMayStopTheChange)
{
  class StoppedProgress : public itk::MedialVoxelNoProgress
  {
  public:
    bool
    IsAborted() const override
    {
      return true;
    }
  };
  const Volume                  volume = VolumeWithPores({ { 20, 20, 20 } }, UnitSpacing, 6, 850);
  VolumeSource                  source(volume);
  itk::MedialVoxelMovingWindow  window(GridOf(volume), Background, false, false, 6);
  const auto                    sites = MakeBox({ { 5, 5, 5 } }, { { 9, 9, 9 } });
  StoppedProgress               progress;
  itk::MedialVoxelProgressScope scope(progress);
  EXPECT_THROW(window.MoveTo(sites, sites, source), itk::MedialVoxelAborted);
}
