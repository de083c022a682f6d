// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-tiles: how long an extraction takes with any number of threads, on paper and for real.
// On paper, one thread does all work of the engine's own schedule in the order in which so many threads would take it:
// each takes work when it is free, and has done it after the processor time that it took. Volumes are headerless files
// of bytes, results go to memory, in pieces as those of the program. Prints JSON that bench/measure_tiles.py reads.

#include "FloorSupport.h"

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelExtractionTask.h"
#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelSlabWalker.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <queue>
#include <string>
#include <thread>
#include <vector>

namespace
{
using Work = itk::MedialVoxelSlabSchedule::Work;
using Phase = itk::MedialVoxelSlabSchedule::Phase;

/** Processor seconds of this thread. */
double
Now()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/** Seconds between two calls of Now(). */
double
MeasureClock()
{
  std::vector<double> seconds(1001);
  for (double & one : seconds)
  {
    const double start = Now();
    one = Now() - start;
  }
  std::nth_element(seconds.begin(), seconds.begin() + 500, seconds.end());
  return seconds[500];
}

/** The job: a volume in a file, and labels of pieces of whole slices. */
class Part
{
public:
  Part(const std::string & name, const std::array<std::int64_t, 3> & size, double thickness)
    : m_Name(name)
    , m_Grid(size, { { 1.0, 1.0, 1.0 } })
  {
    m_Extraction.parameters.epsilon = itk::MedialVoxelParameters::EpsilonFromThickness(thickness);
  }

  itk::MedialVoxelSlabWalker::Settings
  GetSettings(unsigned int threads) const
  {
    auto settings = itk::MedialVoxelSlabWalker::Settings::ForClassification(m_Grid, m_Extraction.parameters, false);
    settings.numberOfWorkers = threads;
    return settings;
  }

  /** As the program cuts them: of 32 MiB, or 2 MiB for each thread, and of a slab at least. */
  std::vector<itk::MedialVoxelBox>
  GetPieces(std::int64_t slabThickness, unsigned int threads) const
  {
    const std::int64_t               bytesOfPiece = std::max<std::int64_t>(32, 2 * threads) << 20;
    const auto &                     size = m_Grid.GetSize();
    const std::int64_t               slices = std::max(slabThickness, bytesOfPiece / (size[0] * size[1]));
    const std::int64_t               number = (size[2] - 1) / std::min(slices, size[2]) + 1;
    std::vector<itk::MedialVoxelBox> pieces;
    for (std::int64_t i = 0, begin = 0; i < number; ++i)
    {
      pieces.push_back(m_Grid.GetVoxelBox());
      pieces.back().lower[2] = begin;
      begin += size[2] / number + (i < size[2] % number ? 1 : 0);
      pieces.back().upper[2] = begin;
    }
    return pieces;
  }

  const itk::MedialVoxelGrid &
  GetGrid() const
  {
    return m_Grid;
  }

  const itk::MedialVoxelSheetExtraction &
  GetExtraction() const
  {
    return m_Extraction;
  }

  /** Reads the voxels of a box and packs them. */
  void
  Fill(const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object) const
  {
    const auto         predicate = itk::MedialVoxelObjectPredicate<unsigned char>::DifferentFrom(0);
    const auto &       size = m_Grid.GetSize();
    const std::int64_t rows = std::max<std::int64_t>(1, (1 << 20) / size[0]);
    std::vector<char>  values;
    std::ifstream      file(m_Name, std::ios::binary);
    for (const itk::MedialVoxelBox & part : itk::MedialVoxelCutIntoTiles(box, { { size[0], rows, 1 } }))
    {
      values.resize(static_cast<std::size_t>(part.NumberOfVoxels()));
      file.seekg((part.lower[2] * size[1] + part.lower[1]) * size[0]);
      if (!file.read(values.data(), static_cast<std::streamsize>(values.size())))
      {
        throw std::runtime_error("\"" + m_Name + "\" cannot be read or is shorter than its size says");
      }
      itk::MedialVoxelPackBox(reinterpret_cast<const unsigned char *>(values.data()),
                              { 1, part.Extent(0), part.Extent(0) * part.Extent(1) },
                              part,
                              predicate,
                              object);
    }
  }

private:
  std::string                     m_Name;
  itk::MedialVoxelGrid            m_Grid;
  itk::MedialVoxelSheetExtraction m_Extraction;
};

/** Threads and results of the engine. */
class Client
  : public itk::MedialVoxelEngineClient
  , public itk::MedialVoxelObjectSource
{
public:
  explicit Client(const Part & part)
    : m_Part(part)
  {}

  void
  BeginPiece(const itk::MedialVoxelBox & piece)
  {
    m_Piece = piece;
    m_Labels.resize(static_cast<std::size_t>(piece.NumberOfVoxels()));
  }

  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return itk::MedialVoxelSourceThreads::Several;
  }

  void
  Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
  {
    m_Part.Fill(box, *targets.object);
  }

  void
  RunWorkers(unsigned int numberOfWorkers, const std::function<void()> & work) override
  {
    std::vector<std::thread> others;
    for (unsigned int i = 1; i < numberOfWorkers; ++i)
    {
      others.emplace_back(work);
    }
    work();
    for (std::thread & other : others)
    {
      other.join();
    }
  }

  void
  TakeTile(const itk::MedialVoxelTileResult & tile) override
  {
    tile.WriteLabels(m_Labels.data() + m_Piece.OffsetOf(tile.box.lower),
                     { 1, m_Piece.Extent(0), m_Piece.Extent(0) * m_Piece.Extent(1) });
  }

private:
  const Part &               m_Part;
  itk::MedialVoxelBox        m_Piece;
  std::vector<unsigned char> m_Labels;
};

/** Does the work of a schedule in one thread, and finds when so many threads would have done it. */
class Simulation : public itk::MedialVoxelScheduleRunner
{
public:
  Simulation(const Part & part, Client & client)
    : m_Client(client)
    , m_Task(part.GetGrid(), part.GetExtraction())
    , m_Workspace(m_Task.MakeWorkspace())
  {}

  void
  RunSchedule(itk::MedialVoxelSlabSchedule & schedule) override
  {
    this->AddSerial("begin", Now() - m_Begin);
    std::priority_queue<Done, std::vector<Done>, std::greater<>> running;
    std::vector<bool>                                            isFree(schedule.GetNumberOfWorkers(), true);
    while (!schedule.IsDone())
    {
      bool hasWork = true; // or threads wait for news
      for (std::size_t worker = 0; worker < isFree.size() && hasWork; ++worker)
      {
        Work work;
        if (isFree[worker] && (hasWork = this->Take(schedule, worker == 0, work)))
        {
          isFree[worker] = false;
          running.push(this->Do(schedule, work, worker));
        }
      }
      const Done next = running.top();
      running.pop();
      m_Seconds = next.seconds;
      isFree[next.worker] = true;
      if (!next.missing.IsEmpty())
      {
        schedule.Defer(next.work, next.missing);
      }
      const double start = Now();
      schedule.Complete(next.work, next.seconds - next.begin);
      this->AddSerial("schedule", Now() - start);
    }
  }

  /** Time that one thread takes while no other one can take work. */
  void
  AddSerial(const char * name, double seconds)
  {
    const double withoutClock = std::max(0.0, seconds - m_SecondsOfClock);
    m_SecondsOfWork[name] += withoutClock;
    m_Seconds += withoutClock;
  }

  /** From here on one thread works until it has others do so too. */
  void
  Begin()
  {
    m_Begin = Now();
  }

  /** When all is done. */
  double
  GetSeconds() const
  {
    return m_Seconds;
  }

  const std::map<std::string, double> &
  GetSecondsOfWork() const
  {
    return m_SecondsOfWork;
  }

  const std::vector<double> &
  GetTileSeconds() const
  {
    return m_TileSeconds;
  }

private:
  struct Done
  {
    double              begin;
    double              seconds;
    std::size_t         worker;
    Work                work;
    itk::MedialVoxelBox missing;

    bool
    operator>(const Done & other) const
    {
      return seconds > other.seconds;
    }
  };

  /** Only one thread at a time takes work, so that all wait for it. */
  bool
  Take(itk::MedialVoxelSlabSchedule & schedule, bool isCallingThread, Work & work)
  {
    const double start = Now();
    const bool   isTaken = schedule.Take(isCallingThread, work);
    this->AddSerial("schedule", Now() - start);
    return isTaken;
  }

  Done
  Do(itk::MedialVoxelSlabSchedule & schedule, const Work & work, std::size_t worker)
  {
    const char * const  names[] = { "fill", "small components", "mark", "tiles" };
    itk::MedialVoxelBox missing;
    const double        start = Now();
    if (work.phase == Phase::Process)
    {
      itk::MedialVoxelSums sums;
      missing = m_Task.Process(work.box, schedule.GetWindow(work), m_Progress, *m_Workspace, m_Client, sums);
    }
    else
    {
      schedule.DoWindowWork(work, m_Client);
    }
    const double seconds = Now() - start;
    m_SecondsOfWork[names[static_cast<int>(work.phase)]] += seconds;
    if (work.phase == Phase::Process)
    {
      m_TileSeconds.push_back(seconds);
    }
    return { m_Seconds, m_Seconds + seconds, worker, work, missing };
  }

  Client &                                             m_Client;
  itk::MedialVoxelExtractionTask                       m_Task;
  std::unique_ptr<itk::MedialVoxelTileTask::Workspace> m_Workspace;
  itk::MedialVoxelNoProgress                           m_Progress;
  double                                               m_SecondsOfClock{ MeasureClock() };
  double                                               m_Begin{ 0.0 };
  double                                               m_Seconds{ 0.0 };
  std::map<std::string, double>                        m_SecondsOfWork;
  std::vector<double>                                  m_TileSeconds;
};

void
Simulate(const Part & part, unsigned int threads)
{
  Client                     client(part);
  itk::MedialVoxelSlabWalker walker(part.GetGrid(), part.GetSettings(threads));
  Simulation                 simulation(part, client);
  const auto                 pieces = part.GetPieces(walker.GetSlabThickness(part.GetGrid().GetVoxelBox()), threads);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    client.BeginPiece(pieces[i]);
    simulation.Begin();
    walker.Run(pieces[i], i + 1 < pieces.size() ? pieces[i + 1] : itk::MedialVoxelBox{}, client, simulation);
  }
  std::cout << "{\"threads\": " << threads << ", \"seconds\": " << simulation.GetSeconds()
            << ", \"pieces\": " << pieces.size() << ", \"work\": {";
  const char * comma = "";
  for (const auto & [name, seconds] : simulation.GetSecondsOfWork())
  {
    std::cout << comma << '"' << name << "\": " << seconds;
    comma = ", ";
  }
  std::cout << "}, \"tile_seconds\": [";
  comma = "";
  for (const double seconds : simulation.GetTileSeconds())
  {
    std::cout << comma << seconds;
    comma = ", ";
  }
  std::cout << "]}\n";
}

void
RunForReal(const Part & part, unsigned int threads)
{
  itk::MedialVoxelEngineSettings settings;
  settings.task = part.GetExtraction();
  settings.numberOfWorkers = threads;
  itk::MedialVoxelEngine engine(part.GetGrid(), settings);
  Client                 client(part);
  const auto             pieces = part.GetPieces(engine.GetSlabThickness(part.GetGrid().GetVoxelBox()), threads);
  const auto             start = std::chrono::steady_clock::now();
  const auto             startOfProcess = std::clock();
  double                 busy = 0.0;
  double                 possible = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    client.BeginPiece(pieces[i]);
    const auto sums =
      engine.Run(pieces[i], client, client, i + 1 < pieces.size() ? pieces[i + 1] : itk::MedialVoxelBox{});
    busy += sums.threadSeconds;
    possible += sums.tileSeconds * threads;
  }
  const double cpu = static_cast<double>(std::clock() - startOfProcess) / CLOCKS_PER_SEC;
  std::cout << "{\"threads\": " << threads << ", \"wall_seconds\": " << SecondsSince(start)
            << ", \"cpu_seconds\": " << cpu << ", \"thread_efficiency\": " << busy / possible << "}\n";
}

} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    const std::string kind = argc == 5 ? argv[1] : "";
    if (kind != "simulate" && kind != "run")
    {
      throw std::invalid_argument("usage: medialvoxel-tiles simulate|run INPUT.raw X,Y,Z THREADS");
    }
    const Part part(argv[2], ParseSize(argv[3]), 3.0);
    const auto threads = static_cast<unsigned int>(std::stoul(argv[4]));
    kind == "run" ? RunForReal(part, threads) : Simulate(part, threads);
    return EXIT_SUCCESS;
  }
  catch (const std::invalid_argument & error)
  {
    std::cerr << "medialvoxel-tiles: " << error.what() << '\n';
    return 2;
  }
  catch (const std::exception & error)
  {
    std::cerr << "medialvoxel-tiles: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
