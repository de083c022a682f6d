// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelMemoryShortage.h"
#include "itkMedialVoxelSlabWalker.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelSlabWalker;

using Work = itk::MedialVoxelSlabSchedule::Work;
using Phase = itk::MedialVoxelSlabSchedule::Phase;

/** Lets every tile need a box around itself, checks that it gets it, and counts how often each voxel was done. Does the
 * work of several workers in one thread, in an order that changes with the seed. */
class DemandingClient
  : public itk::MedialVoxelObjectSource
  , public itk::MedialVoxelScheduleRunner
{
public:
  DemandingClient(const Volume & volume, int reach, unsigned int seed = 1)
    : m_Volume(volume)
    , m_Sites(BoundarySites(volume))
    , m_Done(volume.object.size(), 0)
    , m_Reach(reach)
    , m_Generator(seed)
  {}

  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_Threads;
  }

  void
  Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
  {
    m_FirstFill = m_FirstFill.IsEmpty() ? box : m_FirstFill;
    m_LastFill = box;
    this->MeasureWindow();
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      if (m_Volume.IsObject(OracleIndex(v)))
      {
        targets.object->Set(v);
      }
    });
  }

  void
  RunSchedule(itk::MedialVoxelSlabSchedule & schedule) override
  {
    std::vector<Work> taken;
    while (!schedule.IsDone())
    {
      Work work;
      if (taken.size() < schedule.GetNumberOfWorkers() && schedule.Take(true, work))
      {
        taken.push_back(work);
        continue;
      }
      ASSERT_FALSE(taken.empty()) << "nobody has work, and there is work left";
      std::swap(taken[m_Generator() % taken.size()], taken.back());
      this->Do(schedule, taken.back());
      schedule.Complete(taken.back(), 1e-3 * static_cast<double>(m_Generator() % 100));
      taken.pop_back();
    }
  }

  void
  Do(itk::MedialVoxelSlabSchedule & schedule, const Work & work)
  {
    this->MeasureWindow();
    if (work.phase != Phase::Process)
    {
      m_LastWindow = std::max(m_LastWindow, work.slab);
      schedule.DoWindowWork(work, *this);
      return;
    }
    m_NumberOfSlabs = std::max(m_NumberOfSlabs, static_cast<int>(work.slab));
    m_WasReadAhead = m_WasReadAhead || work.slab < m_LastWindow;
    const auto needed =
      work.box.Expanded({ { m_Reach, m_Reach, m_Reach } }).Intersection(GridOf(m_Volume).GetVoxelBox());
    const auto & bits = *schedule.GetWindow(work).GetWindow(itk::MedialVoxelBoundary::Background).sites;
    if (!bits.GetBox().Contains(needed))
    {
      m_MostDeferrals = std::max(m_MostDeferrals, ++m_Deferrals[m_Volume.Offset(OracleIndex(work.box.lower))]);
      schedule.Defer(work, needed);
      return;
    }
    m_WidestTile = std::max(m_WidestTile, work.box.Extent(0));
    const auto expected = SiteBits(m_Sites, needed);
    ForEachVoxel(needed, [&](const itk::MedialVoxelIndex & v) { m_Wrong += bits.Test(v) != expected.Test(v); });
    ForEachVoxel(work.box, [&](const itk::MedialVoxelIndex & v) { ++m_Done[m_Volume.Offset(OracleIndex(v))]; });
    if (m_FailInSlab == m_NumberOfSlabs)
    {
      throw std::runtime_error("stop");
    }
  }

  /** What the bits have, not what they need. */
  void
  MeasureWindow()
  {
    m_LargestWindowBytes = std::max(m_LargestWindowBytes, m_Engine->GetReservedBytes());
  }

  const Volume &                m_Volume;
  std::vector<Index3>           m_Sites;
  std::vector<int>              m_Done;
  std::map<std::size_t, int>    m_Deferrals; // by the first voxel of the tile
  int                           m_MostDeferrals{ 0 };
  std::size_t                   m_Wrong{ 0 };
  int                           m_Reach;
  std::uint64_t                 m_LargestWindowBytes{ 0 };
  std::int64_t                  m_WidestTile{ 0 };
  int                           m_NumberOfSlabs{ 0 };
  int                           m_FailInSlab{ 0 };
  std::uint64_t                 m_LastWindow{ 0 };
  bool                          m_WasReadAhead{ false }; // for a slab while one before it had tiles
  itk::MedialVoxelBox           m_FirstFill;
  itk::MedialVoxelBox           m_LastFill;
  itk::MedialVoxelSourceThreads m_Threads{ itk::MedialVoxelSourceThreads::Several };
  std::mt19937                  m_Generator;
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
          auto settings = SettingsOf(cut.first, cut.second, { { 2, 2, 2 } });
          settings.numberOfWorkers = generator() % 4 == 0 ? 40 : 1 + static_cast<unsigned int>(generator() % 5);
          DemandingClient       client(volume, reach, static_cast<unsigned int>(generator()));
          MedialVoxelSlabWalker engine(GridOf(volume), settings);
          client.m_Engine = &engine;
          engine.Run(region, {}, client, client);
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
  client.m_Threads = itk::MedialVoxelSourceThreads::Calling;
  const auto missing = engine.GetMissingObjectBoxes(region);
  ASSERT_EQ(missing.size(), 1u);
  const auto announced = missing.front();
  EXPECT_LT(announced.NumberOfVoxels(), GridOf(volume).GetVoxelBox().NumberOfVoxels() / 2);
  engine.Run(region, {}, client, client);
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
  engine.Run(GridOf(volume).GetVoxelBox(), {}, client, client);
  EXPECT_LE(client.m_NumberOfSlabs, 10 + 3); // ten slabs, and few of them twice
}

TEST(MedialVoxelSlabWalker, NoTileIsDeferredTwice)
{
  const Volume volume = RandomBoxes({ { 20, 20, 80 } }, UnitSpacing, 12, 219);
  for (unsigned int seed = 1; seed < 6; ++seed)
  {
    auto settings = SettingsOf(8, 100, { { 2, 2, 2 } });
    settings.numberOfWorkers = 3;
    DemandingClient       client(volume, 9, seed);
    MedialVoxelSlabWalker engine(GridOf(volume), settings);
    client.m_Engine = &engine;
    // Tiles at both ends need more, on different sides.
    engine.Run(MakeBox({ { 0, 0, 20 } }, { { 20, 20, 60 } }), {}, client, client);
    EXPECT_EQ(client.m_MostDeferrals, 1);
  }
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
      settings.numberOfWorkers = 1 + static_cast<unsigned int>(limit / 100000) % 4;
      DemandingClient       client(volume, reach);
      MedialVoxelSlabWalker engine(GridOf(volume), settings);
      client.m_Engine = &engine;
      try
      {
        engine.Run(image, {}, client, client);
      }
      catch (const itk::MedialVoxelMemoryShortage & error)
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
    settings.bytesPerVoxel = 12;
    DemandingClient       client(volume, 70);
    MedialVoxelSlabWalker engine(GridOf(volume), settings);
    client.m_Engine = &engine;
    engine.Run(GridOf(volume).GetVoxelBox(), {}, client, client);
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
  engine.Run(GridOf(volume).GetVoxelBox(), {}, client, client);
  EXPECT_EQ(client.m_Wrong, 0u);
  EXPECT_LE(client.m_LargestWindowBytes, settings.memoryLimit);
}

TEST(MedialVoxelSlabWalker, AFailureOfTheClientEndsTheRun)
{
  const Volume          volume = RandomBoxes({ { 20, 20, 30 } }, UnitSpacing, 12, 214);
  DemandingClient       client(volume, 1);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 8, { { 2, 2, 2 } }));
  client.m_Engine = &engine;
  client.m_FailInSlab = 2;
  EXPECT_THROW(engine.Run(GridOf(volume).GetVoxelBox(), {}, client, client), std::runtime_error);
  EXPECT_EQ(client.m_NumberOfSlabs, 2);
  // What the windows held is not known, and forgotten.
  EXPECT_EQ(engine.GetReservedBytes(), 0u);
}

TEST(MedialVoxelSlabWalker, ATileThatWantsNothingNewEndsTheRun)
{
  // Instead of deferring it for ever.
  class StubbornClient : public DemandingClient
  {
  public:
    using DemandingClient::DemandingClient;
    void
    RunSchedule(itk::MedialVoxelSlabSchedule & schedule) override
    {
      for (Work work; schedule.Take(true, work); schedule.Complete(work, 0.0))
      {
        if (work.phase == Phase::Process)
        {
          schedule.Defer(work, work.box);
        }
        else
        {
          schedule.DoWindowWork(work, *this);
        }
      }
    }
  };
  const Volume          volume({ { 20, 20, 30 } }, UnitSpacing);
  StubbornClient        client(volume, 1);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 8, { { 2, 2, 2 } }));
  client.m_Engine = &engine;
  EXPECT_THROW(engine.Run(GridOf(volume).GetVoxelBox(), {}, client, client), std::logic_error);
}

TEST(MedialVoxelSlabWalker, AnEmptyRegionIsNoWork)
{
  const Volume          volume({ { 20, 20, 30 } }, UnitSpacing);
  DemandingClient       client(volume, 1);
  MedialVoxelSlabWalker engine(GridOf(volume), SettingsOf(8, 8, { { 2, 2, 2 } }));
  client.m_Engine = &engine;
  engine.Run(itk::MedialVoxelBox{}, {}, client, client);
  EXPECT_EQ(client.m_NumberOfSlabs, 0);
}

TEST(MedialVoxelSlabWalker, TheNextWindowIsPreparedWhileThereAreTiles)
{
  const Volume volume = RandomBoxes({ { 40, 20, 80 } }, UnitSpacing, 12, 218);
  for (const bool readsAhead : { true, false })
  {
    auto settings = SettingsOf(8, 8, { { 2, 2, 2 } });
    settings.numberOfWorkers = 3;
    settings.readsAhead = readsAhead;
    DemandingClient       client(volume, 2);
    MedialVoxelSlabWalker engine(GridOf(volume), settings);
    client.m_Engine = &engine;
    const std::uint64_t planned = engine.GetBytes(GridOf(volume).GetVoxelBox());
    engine.Run(GridOf(volume).GetVoxelBox(), {}, client, client);
    EXPECT_EQ(client.m_Wrong, 0u);
    EXPECT_EQ(client.m_WasReadAhead, readsAhead);
    EXPECT_LE(client.m_LargestWindowBytes, planned);
  }
}

TEST(MedialVoxelSlabWalker, ASecondWindowIsTakenOnlyWhereItFits)
{
  const Volume volume = RandomBoxes({ { 40, 20, 80 } }, UnitSpacing, 12, 219);
  const auto   image = GridOf(volume).GetVoxelBox();
  auto         settings = SettingsOf(8, 8, { { 2, 2, 2 } });
  settings.numberOfWorkers = 3;
  const std::uint64_t both = MedialVoxelSlabWalker(GridOf(volume), settings).GetBytes(image);
  settings.readsAhead = false;
  const std::uint64_t one = MedialVoxelSlabWalker(GridOf(volume), settings).GetBytes(image);
  EXPECT_GT(both, one);
  settings.readsAhead = true;
  for (const std::uint64_t limit : { one, (one + both) / 2, both })
  {
    settings.memoryLimit = limit;
    DemandingClient       client(volume, 2);
    MedialVoxelSlabWalker engine(GridOf(volume), settings);
    client.m_Engine = &engine;
    EXPECT_EQ(engine.GetBytes(image), limit == both ? both : one);
    engine.Run(image, {}, client, client);
    EXPECT_EQ(client.m_Wrong, 0u);
    EXPECT_EQ(client.m_WasReadAhead, limit == both);
    EXPECT_LE(client.m_LargestWindowBytes, limit);
  }
}

TEST(MedialVoxelSlabWalker, TheNextRegionIsReadAhead)
{
  const Volume volume = RandomBoxes({ { 40, 20, 80 } }, UnitSpacing, 12, 220);
  const auto   first = MakeBox({ { 0, 0, 0 } }, { { 40, 20, 32 } });
  const auto   second = MakeBox({ { 0, 0, 32 } }, { { 40, 20, 64 } });
  auto         settings = SettingsOf(8, 16, { { 2, 2, 2 } });
  settings.numberOfWorkers = 3;
  DemandingClient       client(volume, 2);
  MedialVoxelSlabWalker engine(GridOf(volume), settings);
  client.m_Engine = &engine;
  engine.Run(first, second, client, client);
  EXPECT_TRUE(engine.GetMissingObjectBoxes(second).empty());
  EXPECT_EQ(std::count(client.m_Done.begin(), client.m_Done.end(), 1), first.NumberOfVoxels());
  client.m_LastFill = {};
  engine.Run(second, {}, client, client);
  EXPECT_EQ(client.m_Wrong, 0u);
  // The first slab of the second region needed nothing.
  EXPECT_GE(client.m_LastFill.lower[2], 50);
}

TEST(MedialVoxelSlabWalker, OnlyTheThreadsThatMayAskTheSourceDoSo)
{
  using itk::MedialVoxelSourceThreads;
  const Volume volume = RandomBoxes({ { 40, 20, 80 } }, UnitSpacing, 12, 221);

  /** Counts what two threads may take at the same time. */
  class TakingClient : public DemandingClient
  {
  public:
    using DemandingClient::DemandingClient;
    void
    RunSchedule(itk::MedialVoxelSlabSchedule & schedule) override
    {
      Work first;
      Work second;
      m_OtherMayFill = schedule.Take(false, first);
      m_CallingMayFill = m_OtherMayFill || schedule.Take(true, first);
      m_BothMayFill = schedule.Take(true, second);
      throw std::runtime_error("enough");
    }
    bool m_OtherMayFill{ false };
    bool m_CallingMayFill{ false };
    bool m_BothMayFill{ false };
  };

  for (const auto threads :
       { MedialVoxelSourceThreads::Calling, MedialVoxelSourceThreads::OneAtATime, MedialVoxelSourceThreads::Several })
  {
    auto settings = SettingsOf(8, 16, { { 2, 2, 2 } });
    settings.numberOfWorkers = 3;
    TakingClient client(volume, 2);
    client.m_Threads = threads;
    MedialVoxelSlabWalker engine(GridOf(volume), settings);
    EXPECT_THROW(engine.Run(GridOf(volume).GetVoxelBox(), {}, client, client), std::runtime_error);
    EXPECT_EQ(client.m_OtherMayFill, threads != MedialVoxelSourceThreads::Calling);
    EXPECT_TRUE(client.m_CallingMayFill);
    EXPECT_EQ(client.m_BothMayFill, threads == MedialVoxelSourceThreads::Several);
  }
}
