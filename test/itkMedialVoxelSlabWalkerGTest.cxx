// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSlabWalker.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelSlabWalker;

/** Lets every tile need a box around itself, checks that it gets it, and counts how often each voxel was done. */
class DemandingClient : public itk::MedialVoxelTileRunner
{
public:
  DemandingClient(const Volume & volume, int reach)
    : m_Volume(volume)
    , m_Sites(BoundarySites(volume))
    , m_Done(volume.object.size(), 0)
    , m_Reach(reach)
  {}

  void
  FillObject(const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object, itk::MedialVoxelBits *) override
  {
    m_FirstFill = m_FirstFill.IsEmpty() ? box : m_FirstFill;
    this->MeasureWindow();
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      if (m_Volume.IsObject(OracleIndex(v)))
      {
        object.Set(v);
      }
    });
  }

  void
  RunTiles(itk::MedialVoxelTileSchedule & schedule) override
  {
    ++m_Rounds;
    this->MeasureWindow();
    itk::MedialVoxelBox tile;
    while (schedule.Next(tile))
    {
      const auto needed = tile.Expanded({ { m_Reach, m_Reach, m_Reach } }).Intersection(GridOf(m_Volume).GetVoxelBox());
      const auto & bits = *m_Engine->GetWindow().GetWindow(itk::MedialVoxelBoundary::Background).sites;
      if (!bits.GetBox().Contains(needed))
      {
        schedule.Defer(tile, needed);
        continue;
      }
      m_WidestTile = std::max(m_WidestTile, tile.Extent(0));
      const auto expected = SiteBits(m_Sites, needed);
      ForEachVoxel(needed, [&](const itk::MedialVoxelIndex & v) { m_Wrong += bits.Test(v) != expected.Test(v); });
      ForEachVoxel(tile, [&](const itk::MedialVoxelIndex & v) { ++m_Done[m_Volume.Offset(OracleIndex(v))]; });
      if (m_FailInRound == m_Rounds)
      {
        throw std::runtime_error("stop");
      }
    }
  }

  /** What the bits have, not what they need. */
  void
  MeasureWindow()
  {
    const auto window = m_Engine->GetWindow().GetWindow(itk::MedialVoxelBoundary::Background);
    m_LargestWindowBytes =
      std::max(m_LargestWindowBytes, window.object->GetReservedBytes() + window.sites->GetReservedBytes());
  }

  const Volume &                m_Volume;
  std::vector<Index3>           m_Sites;
  std::vector<int>              m_Done;
  std::size_t                   m_Wrong{ 0 };
  int                           m_Reach;
  std::uint64_t                 m_LargestWindowBytes{ 0 };
  std::int64_t                  m_WidestTile{ 0 };
  int                           m_Rounds{ 0 };
  int                           m_FailInRound{ 0 };
  itk::MedialVoxelBox           m_FirstFill;
  const MedialVoxelSlabWalker * m_Engine{ nullptr };
};

MedialVoxelSlabWalker::Settings
SettingsOf(std::int64_t tileSize, std::int64_t slabThickness, const itk::MedialVoxelIndex & halo)
{
  MedialVoxelSlabWalker::Settings settings;
  settings.boundaries = { itk::MedialVoxelBoundary::Background };
  settings.halo = halo;
  settings.upperMargin = { { 1, 1, 1 } };
  settings.tileSize = tileSize;
  settings.slabThickness = slabThickness;
  return settings;
}
} // namespace

TEST(MedialVoxelSlabWalker, EveryTileIsDoneOnceWithAllThatItNeeds)
{
  for (const Index3 & size : { Index3{ { 40, 22, 25 } }, Index3{ { 40, 33, 1 } }, Index3{ { 90, 1, 1 } } })
  {
    const Volume volume = RandomBoxes(size, UnitSpacing, 12, 211);
    std::mt19937 generator(11);
    for (const auto & cut : { std::make_pair(0, 0), { 7, 3 }, { 16, 100 }, { 1000, 1 } })
    {
      for (const int reach : { 0, 4, 30 })
      {
        for (const auto & region : { GridOf(volume).GetVoxelBox(), RandomBox(size, generator) })
        {
          DemandingClient       client(volume, reach);
          MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(cut.first, cut.second, { { 2, 2, 2 } }));
          client.m_Engine = &engine;
          engine.Run(region, client);
          EXPECT_EQ(client.m_Wrong, 0u);
          std::size_t differences = 0;
          for (std::size_t i = 0; i < client.m_Done.size(); ++i)
          {
            differences += client.m_Done[i] != (region.Contains(KernelIndex(volume.IndexAt(i))) ? 1 : 0) ? 1 : 0;
          }
          EXPECT_EQ(differences, 0u);
        }
      }
    }
  }
}

TEST(MedialVoxelSlabWalker, StartsWithTheBoxThatItAnnounces)
{
  const Volume          volume = RandomBoxes({ { 40, 22, 60 } }, UnitSpacing, 12, 212);
  const auto            region = MakeBox({ { 5, 4, 20 } }, { { 30, 18, 50 } });
  DemandingClient       client(volume, 2);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 6, { { 3, 3, 3 } }));
  client.m_Engine = &engine;
  const auto missing = engine.GetMissingObjectBoxes(region);
  ASSERT_EQ(missing.size(), 1u);
  const auto announced = missing.front();
  EXPECT_LT(announced.NumberOfVoxels(), GridOf(volume).GetVoxelBox().NumberOfVoxels() / 2);
  engine.Run(region, client);
  EXPECT_EQ(client.m_FirstFill, announced);
  // The window stays, so that a region that it holds misses nothing.
  EXPECT_TRUE(engine.GetMissingObjectBoxes(MakeBox({ { 5, 4, 48 } }, { { 30, 18, 50 } })).empty());
}

TEST(MedialVoxelSlabWalker, LargeDemandsAreRememberedForTheNextSlabs)
{
  const Volume          volume = RandomBoxes({ { 20, 20, 80 } }, UnitSpacing, 12, 213);
  DemandingClient       client(volume, 9);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 8, { { 2, 2, 2 } }));
  client.m_Engine = &engine;
  engine.Run(GridOf(volume).GetVoxelBox(), client);
  EXPECT_LE(client.m_Rounds, 10 + 3); // ten slabs, and few of them twice
}

TEST(MedialVoxelSlabWalker, AMemoryLimitHoldsAndChangesNothingElse)
{
  const Index3 size{ { 70, 40, 60 } };
  const Volume volume = RandomBoxes(size, UnitSpacing, 20, 215);
  const auto   image = GridOf(volume).GetVoxelBox();
  int          refused = 0;
  for (const int reach : { 0, 3, 17, 40 })
  {
    for (const std::uint64_t limit : { 60000u, 300000u, 600000u, 900000u, 1600000u })
    {
      auto settings = SettingsOf(0, 0, { { 2, 2, 2 } });
      settings.memoryLimit = limit;
      DemandingClient       client(volume, reach);
      MedialVoxelSlabWalker engine(GridOf(volume), settings);
      client.m_Engine = &engine;
      try
      {
        engine.Run(image, client);
      }
      catch (const itk::MedialVoxelMemoryError & error)
      {
        EXPECT_GT(error.GetNeededBytes(), settings.memoryLimit);
        ++refused;
        continue;
      }
      EXPECT_EQ(client.m_Wrong, 0u);
      EXPECT_EQ(std::count(client.m_Done.begin(), client.m_Done.end(), 1), image.NumberOfVoxels());
      EXPECT_LE(client.m_LargestWindowBytes, settings.memoryLimit);
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 12);
}

TEST(MedialVoxelSlabWalker, ThickPartsAreCutIntoWideTiles)
{
  const Volume volume = RandomBoxes({ { 1100, 70, 40 } }, UnitSpacing, 20, 217);
  for (const std::uint64_t limit : { 0u, 12000000u })
  {
    auto settings = SettingsOf(0, 0, { { 80, 80, 80 } });
    settings.memoryLimit = limit;
    settings.workerBytesPerVoxel = 12;
    DemandingClient       client(volume, 70);
    MedialVoxelSlabWalker engine(GridOf(volume), settings);
    client.m_Engine = &engine;
    engine.Run(GridOf(volume).GetVoxelBox(), client);
    EXPECT_EQ(client.m_Wrong, 0u);
    EXPECT_EQ(std::count(client.m_Done.begin(), client.m_Done.end(), 1), GridOf(volume).GetVoxelBox().NumberOfVoxels());
    EXPECT_EQ(client.m_WidestTile, 576);
  }
}

TEST(MedialVoxelSlabWalker, AHaloThatDoesNotFitIsTriedSmaller)
{
  const Volume volume = RandomBoxes({ { 64, 40, 60 } }, UnitSpacing, 20, 216);
  auto         settings = SettingsOf(8, 8, { { 50, 50, 50 } });
  settings.memoryLimit = 130000;
  DemandingClient       client(volume, 3);
  MedialVoxelSlabWalker engine(GridOf(volume), settings);
  client.m_Engine = &engine;
  engine.Run(GridOf(volume).GetVoxelBox(), client);
  EXPECT_EQ(client.m_Wrong, 0u);
  EXPECT_LE(client.m_LargestWindowBytes, settings.memoryLimit);
}

TEST(MedialVoxelSlabWalker, AFailureOfTheClientEndsTheRun)
{
  const Volume          volume = RandomBoxes({ { 20, 20, 30 } }, UnitSpacing, 12, 214);
  DemandingClient       client(volume, 1);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 8, { { 2, 2, 2 } }));
  client.m_Engine = &engine;
  client.m_FailInRound = 2;
  EXPECT_THROW(engine.Run(GridOf(volume).GetVoxelBox(), client), std::runtime_error);
  EXPECT_EQ(client.m_Rounds, 2);
}

TEST(MedialVoxelSlabWalker, ATileThatWantsNothingNewEndsTheRun)
{
  // Instead of deferring it for ever.
  class StubbornClient : public DemandingClient
  {
  public:
    using DemandingClient::DemandingClient;
    void
    RunTiles(itk::MedialVoxelTileSchedule & schedule) override
    {
      itk::MedialVoxelBox tile;
      while (schedule.Next(tile))
      {
        schedule.Defer(tile, tile);
      }
    }
  };
  const Volume          volume({ { 20, 20, 30 } }, UnitSpacing);
  StubbornClient        client(volume, 1);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 8, { { 2, 2, 2 } }));
  client.m_Engine = &engine;
  EXPECT_THROW(engine.Run(GridOf(volume).GetVoxelBox(), client), std::logic_error);
}

TEST(MedialVoxelSlabWalker, AnEmptyRegionIsNoWork)
{
  const Volume          volume({ { 20, 20, 30 } }, UnitSpacing);
  DemandingClient       client(volume, 1);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 8, { { 2, 2, 2 } }));
  client.m_Engine = &engine;
  engine.Run(itk::MedialVoxelBox{}, client);
  EXPECT_EQ(client.m_Rounds, 0);
}
