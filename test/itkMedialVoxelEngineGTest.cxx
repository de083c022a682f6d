// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The engine without a filter, and the observers of its tiles.

#include "MedialVoxelTestHardCases.h"
#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestThreads.h"

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelTileObserver.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace
{
using namespace MedialVoxelTest;

/** Threads, voxels and labels without ITK. */
class PlainClient
  : public itk::MedialVoxelEngineClient
  , public itk::MedialVoxelObjectSource
{
public:
  explicit PlainClient(const Volume & volume)
    : m_Volume(volume)
    , m_Labels(volume.object.size(), 255)
    , m_NearestX(volume.object.size(), 0)
  {}

  void
  Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
  {
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      if (m_Volume.IsObject(OracleIndex(v)))
      {
        targets.object->Set(v);
      }
    });
  }

  void
  RunWorkers(const unsigned int numberOfWorkers, const std::function<void()> & work) override
  {
    RunInThreads(numberOfWorkers, work);
  }

  void
  TakeTile(const itk::MedialVoxelTileResult & tile) override
  {
    std::size_t number = 0;
    ForEachVoxel(tile.box, [&](const itk::MedialVoxelIndex & v) {
      const std::size_t at = m_Volume.Offset(OracleIndex(v));
      m_Labels[at] = tile.labels == nullptr ? 0 : tile.labels[number++];
      m_NearestX[at] =
        tile.displacements == nullptr ? 0 : tile.displacements->dx[tile.displacements->OffsetOf(v[0], v[1], v[2])];
    });
    ++m_NumberOfTiles;
  }

  bool
  IsAborted() const override
  {
    return m_NumberOfTiles >= m_TilesToAbort;
  }

  const Volume &             m_Volume;
  std::vector<unsigned char> m_Labels;
  std::vector<std::int32_t>  m_NearestX;
  std::atomic<int>           m_NumberOfTiles{ 0 };
  int                        m_TilesToAbort{ 1 << 30 };
};

/** Counts how often it has seen each voxel, and how often it was told to begin and to commit. */
class CountingObserver : public itk::MedialVoxelTileObserver
{
public:
  explicit CountingObserver(const Volume & volume)
    : m_Volume(volume)
    , m_Seen(volume.object.size(), 0)
  {}

  std::uint64_t
  GetBytesPerVoxel() const override
  {
    return 1;
  }

  void
  Begin() override
  {
    ++m_Begun;
  }

  void
  Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace *) override
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    ForEachVoxel(tile.box, [&](const itk::MedialVoxelIndex & v) { ++m_Seen[m_Volume.Offset(OracleIndex(v))]; });
  }

  void
  Commit() override
  {
    ++m_Committed;
  }

  const Volume &   m_Volume;
  std::mutex       m_Mutex;
  std::vector<int> m_Seen;
  int              m_Begun{ 0 };
  int              m_Committed{ 0 };
};

/** Needs to know the boundary far around each tile. */
class DemandingObserver : public CountingObserver
{
public:
  using CountingObserver::CountingObserver;

  itk::MedialVoxelBox
  Examine(const itk::MedialVoxelClassifiedTile & tile, Workspace *) const override
  {
    const itk::MedialVoxelBox needed =
      tile.box.Expanded({ { 40, 40, 40 } }).Intersection(GridOf(m_Volume).GetVoxelBox());
    return tile.window.sites->GetBox().Contains(needed) ? itk::MedialVoxelBox{} : needed;
  }
};

itk::MedialVoxelEngineSettings
SettingsFor(const itk::MedialVoxelEngineTask & task)
{
  itk::MedialVoxelEngineSettings settings;
  settings.task = task;
  settings.tileSize = 16;
  settings.slabThickness = 16;
  settings.numberOfWorkers = 2;
  return settings;
}

itk::MedialVoxelSheetExtraction
ExtractionOf(double thickness)
{
  itk::MedialVoxelSheetExtraction extraction;
  extraction.parameters =
    itk::MedialVoxelParameters::ForThickness(thickness, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
  return extraction;
}

const Volume &
Boxes()
{
  static const Volume volume = RandomBoxes({ { 60, 50, 90 } }, UnitSpacing, 20, 321);
  return volume;
}
} // namespace

TEST(MedialVoxelEngine, ExtractsAsTheFilterDoes)
{
  PlainClient            client(Boxes());
  itk::MedialVoxelEngine engine(GridOf(Boxes()), SettingsFor(ExtractionOf(3.0)));
  const auto             sums = engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client);
  const auto             expected = RunMedialFilter<3>(Boxes(), 3.0);
  EXPECT_TRUE(AreEqual(client.m_Labels, expected.labels));
  EXPECT_EQ(sums.counts.boundCells, expected.counts.boundCells);
  EXPECT_EQ(sums.counts.trivialCells, expected.counts.trivialCells);
  EXPECT_GT(sums.counts.boundaryVoxels, 0u);
}

TEST(MedialVoxelEngine, FindsTheNearestVoxels)
{
  PlainClient            client(Boxes());
  itk::MedialVoxelEngine engine(GridOf(Boxes()),
                                SettingsFor(itk::MedialVoxelDistanceMap{ itk::MedialVoxelBoundary::Background }));
  engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client);
  const auto  sites = BoundarySites(Boxes());
  const auto  nearest = NearestSites(Boxes(), sites, std::vector<unsigned char>(Boxes().object.size(), 1));
  std::size_t differences = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    differences += client.m_NearestX[i] != sites[nearest[i]][0] - Boxes().IndexAt(i)[0] ? 1 : 0;
  }
  EXPECT_EQ(differences, 0u);
}

TEST(MedialVoxelEngine, StopsWhenTheClientWantsIt)
{
  PlainClient                     client(Boxes());
  CountingObserver                observer(Boxes());
  itk::MedialVoxelSheetExtraction extraction = ExtractionOf(3.0);
  extraction.AddObserver(observer);
  itk::MedialVoxelEngine engine(GridOf(Boxes()), SettingsFor(extraction));
  client.m_TilesToAbort = 5;
  EXPECT_THROW(engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client), itk::MedialVoxelAborted);
  EXPECT_EQ(observer.m_Begun, 1);
  EXPECT_EQ(observer.m_Committed, 0);
}

TEST(MedialVoxelEngine, KnowsTheLastRegion)
{
  const itk::MedialVoxelEngine engine(GridOf(Boxes()), SettingsFor(ExtractionOf(3.0)));
  EXPECT_FALSE(engine.IsLast(MakeBox({ { 0, 0, 0 } }, { { 60, 50, 89 } })));
  EXPECT_TRUE(engine.IsLast(MakeBox({ { 0, 0, 80 } }, { { 60, 50, 90 } })));
}

/** Also when another one asks for more after it, and when what was cut into tiles is cut again to fit the memory. */
TEST(MedialVoxelEngine, NoObserverSeesATileTwice)
{
  for (const std::uint64_t limit : { 0u, 1500000u })
  {
    CountingObserver                first(Boxes());
    DemandingObserver               demanding(Boxes());
    CountingObserver                last(Boxes());
    itk::MedialVoxelSheetExtraction extraction = ExtractionOf(3.0);
    for (itk::MedialVoxelTileObserver * const observer : { static_cast<itk::MedialVoxelTileObserver *>(&first),
                                                           static_cast<itk::MedialVoxelTileObserver *>(&demanding),
                                                           static_cast<itk::MedialVoxelTileObserver *>(&last) })
    {
      extraction.AddObserver(*observer);
    }
    auto settings = SettingsFor(extraction);
    settings.memoryLimit = limit;
    PlainClient            client(Boxes());
    itk::MedialVoxelEngine engine(GridOf(Boxes()), settings);
    const auto             sums = engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client);
    EXPECT_GT(sums.recomputedVoxels, 0u);
    EXPECT_EQ(*std::max_element(first.m_Seen.begin(), first.m_Seen.end()), 1);
    EXPECT_EQ(first.m_Seen, demanding.m_Seen);
    EXPECT_EQ(first.m_Seen, last.m_Seen);
    EXPECT_EQ(first.m_Committed, 1);
  }
}

TEST(MedialVoxelEngine, ThePlanCountsTheMemoryOfObservers)
{
  CountingObserver                observer(Boxes());
  itk::MedialVoxelSheetExtraction extraction = ExtractionOf(3.0);
  extraction.isObserved = true;
  const auto box = GridOf(Boxes()).GetVoxelBox();
  const auto without = itk::MedialVoxelEngine(GridOf(Boxes()), SettingsFor(extraction)).GetBytes(box);
  extraction.AddObserver(observer);
  const auto with = itk::MedialVoxelEngine(GridOf(Boxes()), SettingsFor(extraction)).GetBytes(box);
  // Two workers, and the corners of the last cells of their tiles.
  EXPECT_EQ(with - without, 2u * 17 * 17 * 17);
}

namespace
{
/** Remembers the threads that ask for voxels, what is asked for while there are tiles, and fails or stops there. */
class WatchfulClient : public PlainClient
{
public:
  using PlainClient::PlainClient;

  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_Threads;
  }

  void
  Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
  {
    const int asking = ++m_Asking;
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      m_MostAsking = std::max(m_MostAsking, asking);
      m_OthersHaveAsked = m_OthersHaveAsked || std::this_thread::get_id() != m_CallingThread;
    }
    if (box.upper[2] > m_SliceToFail)
    {
      throw std::runtime_error("the disk is on fire");
    }
    while (box.upper[2] > m_SliceToWait)
    {
      // As a file that does not come: only an abort ends this.
      m_IsWaiting = true;
      itk::MedialVoxelCheckAbort();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    PlainClient::Fill(box, targets);
    --m_Asking;
  }

  void
  TakeTile(const itk::MedialVoxelTileResult & tile) override
  {
    PlainClient::TakeTile(tile);
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_LastSlice = std::max(m_LastSlice, tile.box.upper[2]);
  }

  bool
  IsAborted() const override
  {
    EXPECT_EQ(std::this_thread::get_id(), m_CallingThread);
    return m_IsWaiting;
  }

  void
  UpdateProgress(float) override
  {
    EXPECT_EQ(std::this_thread::get_id(), m_CallingThread);
  }

  itk::MedialVoxelSourceThreads m_Threads{ itk::MedialVoxelSourceThreads::Several };
  std::int64_t                  m_SliceToFail{ 1 << 30 };
  std::int64_t                  m_SliceToWait{ 1 << 30 };
  std::thread::id               m_CallingThread{ std::this_thread::get_id() };
  std::atomic<int>              m_Asking{ 0 };
  std::atomic<bool>             m_IsWaiting{ false };
  std::int64_t                  m_LastSlice{ 0 };
  std::mutex                    m_Mutex;
  int                           m_MostAsking{ 0 };
  bool                          m_OthersHaveAsked{ false };
};

itk::MedialVoxelEngineSettings
SettingsOfWorkers(unsigned int workers)
{
  auto settings = SettingsFor(ExtractionOf(3.0));
  settings.numberOfWorkers = workers;
  return settings;
}
} // namespace

TEST(MedialVoxelEngine, ResultsDoNotDependOnWhoAsksForVoxels)
{
  const auto                expected = RunMedialFilter<3>(Boxes(), 3.0);
  const itk::MedialVoxelBox image = GridOf(Boxes()).GetVoxelBox();
  const itk::MedialVoxelBox first = MakeBox({ { 0, 0, 0 } }, { { 60, 50, 40 } });
  const itk::MedialVoxelBox second = MakeBox({ { 0, 0, 40 } }, { { 60, 50, 90 } });
  using Threads = itk::MedialVoxelSourceThreads;
  for (const auto threads : { Threads::Calling, Threads::OneAtATime, Threads::Several })
  {
    for (const unsigned int workers : { 1u, 2u, 5u })
    {
      WatchfulClient client(Boxes());
      client.m_Threads = threads;
      itk::MedialVoxelEngine engine(GridOf(Boxes()), SettingsOfWorkers(workers));
      auto                   sums = engine.Run(first, client, client, second);
      sums += engine.Run(second, client, client);
      EXPECT_TRUE(AreEqual(client.m_Labels, expected.labels)) << workers;
      EXPECT_EQ(sums.counts.boundCells, expected.counts.boundCells);
      EXPECT_LE(client.m_MostAsking, threads == Threads::Several ? static_cast<int>(workers) : 1);
      EXPECT_FALSE(threads == Threads::Calling && client.m_OthersHaveAsked);
      EXPECT_EQ(client.m_LastSlice, image.upper[2]);
    }
  }
}

TEST(MedialVoxelEngine, AFailureWhileItReadsAheadEndsTheRun)
{
  for (const auto threads : { itk::MedialVoxelSourceThreads::Calling, itk::MedialVoxelSourceThreads::Several })
  {
    WatchfulClient client(Boxes());
    client.m_Threads = threads;
    client.m_SliceToFail = 70;
    itk::MedialVoxelEngine engine(GridOf(Boxes()), SettingsOfWorkers(3));
    try
    {
      engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client);
      FAIL() << "no exception";
    }
    catch (const std::runtime_error & error)
    {
      EXPECT_STREQ(error.what(), "the disk is on fire");
    }
    EXPECT_LT(client.m_LastSlice, 70);
    // The engine can be run again.
    client.m_SliceToFail = 1 << 30;
    engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client);
    EXPECT_TRUE(AreEqual(client.m_Labels, RunMedialFilter<3>(Boxes(), 3.0).labels));
  }
}

TEST(MedialVoxelEngine, AStopIsHeardWhileItReadsAhead)
{
  using Clock = std::chrono::steady_clock;
  for (const auto threads : { itk::MedialVoxelSourceThreads::Calling, itk::MedialVoxelSourceThreads::Several })
  {
    WatchfulClient client(Boxes());
    client.m_Threads = threads;
    client.m_SliceToWait = 70;
    itk::MedialVoxelEngine engine(GridOf(Boxes()), SettingsOfWorkers(3));
    const auto             start = Clock::now();
    EXPECT_THROW(engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client), itk::MedialVoxelAborted);
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 1.0 * Patience());
  }
}

TEST(MedialVoxelEngine, TilesRunWhileTheNextWindowWaits)
{
  /** The first voxels of the second slab do not come before a tile of the first one is done. */
  class PatientClient : public WatchfulClient
  {
  public:
    using WatchfulClient::WatchfulClient;
    void
    Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
    {
      const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (box.upper[2] > 30 && m_NumberOfTiles == 0 && std::chrono::steady_clock::now() < end)
      {
        std::this_thread::yield();
      }
      m_HasWaitedInVain = m_HasWaitedInVain || (box.upper[2] > 30 && m_NumberOfTiles == 0);
      WatchfulClient::Fill(box, targets);
    }
    std::atomic<bool> m_HasWaitedInVain{ false };
  };
  PatientClient          client(Boxes());
  itk::MedialVoxelEngine engine(GridOf(Boxes()), SettingsOfWorkers(2));
  engine.Run(GridOf(Boxes()).GetVoxelBox(), client, client);
  EXPECT_FALSE(client.m_HasWaitedInVain);
}
