// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Aborts and progress events in work of which a single tile takes minutes.

#include "MedialVoxelTestHardCases.h"

#include "itkMedialVoxelBucketQueue.h"
#include "itkMedialSurfaceMeshFilter.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <thread>

namespace
{
using namespace MedialVoxelTest;

/** Seconds that this thread has computed; others on the machine do not count, where the system tells. */
double
SecondsOfThread()
{
#ifdef CLOCK_THREAD_CPUTIME_ID
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
#else
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
#endif
}

/** Counts how often it is asked. */
class CheckRecorder : public itk::MedialVoxelProgress
{
public:
  bool
  IsAborted() const override
  {
    ++m_NumberOfRequests;
    return false;
  }

  void
  Advance(std::uint64_t) override
  {}

  mutable std::uint64_t m_NumberOfRequests{ 0 };
};

/** The longest time that an update in one thread computes from one progress event to the next, in its first seconds. An
 * event comes with the first check after a tenth of a second: the time exceeds that by the time between two checks. */
template <typename TFilter>
double
FindLongestSilence(TFilter & filter, const double secondsToAbort)
{
  filter.SetNumberOfWorkUnits(1);
  const double start = SecondsOfThread();
  double       last = 0.0;
  double       longest = 0.0;
  filter.AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    const double now = SecondsOfThread();
    longest = last > 0.0 ? std::max(longest, now - last) : 0.0;
    last = now;
    if (now - start > secondsToAbort)
    {
      filter.AbortGenerateDataOn();
    }
  });
  try
  {
    filter.Update();
  }
  catch (const itk::ProcessAborted &)
  {}
  EXPECT_GT(last, 0.0);
  return longest;
}

/** Calls AbortGenerateDataOn() at the first progress event from some seconds after the begin on. */
class LateAborter
{
public:
  LateAborter(itk::ProcessObject & filter, double seconds)
    : m_Filter(filter)
    , m_Tag(filter.AddObserver(itk::ProgressEvent(), [this, seconds](const itk::EventObject &) {
      this->Note();
      if (!m_HasAborted && SecondsSince(m_Start) >= seconds)
      {
        m_HasAborted = true;
        m_Aborted = Clock::now();
        m_Filter.AbortGenerateDataOn();
      }
    }))
  {}

  ~LateAborter() { m_Filter.RemoveObserver(m_Tag); }

  /** What ITK is told about progress must not fall. */
  void
  Note()
  {
    m_LongestSilence = std::max(m_LongestSilence, SecondsSince(m_LastEvent));
    m_LastEvent = Clock::now();
    m_Falls = m_Falls || m_Filter.GetProgress() < m_Fraction;
    m_Fraction = m_Filter.GetProgress();
  }

  itk::ProcessObject & m_Filter;
  Clock::time_point    m_Start{ Clock::now() };
  Clock::time_point    m_LastEvent{ Clock::now() };
  Clock::time_point    m_Aborted;
  double               m_LongestSilence{ 0.0 };
  float                m_Fraction{ 0.0f };
  bool                 m_HasAborted{ false };
  bool                 m_Falls{ false };
  unsigned long        m_Tag;
};

template <typename TFilter>
void
ExpectAbortWithinASecond(TFilter & filter, const std::string & name)
{
  LateAborter aborter(filter, 0.5);
  try
  {
    filter.Update();
    EXPECT_FALSE(aborter.m_HasAborted) << name << ": the abort was not heard";
    std::cout << name << ": took only " << SecondsSince(aborter.m_Start) << " s" << std::endl;
    return;
  }
  catch (const itk::ProcessAborted &)
  {}
  EXPECT_TRUE(aborter.m_HasAborted) << name;
  EXPECT_LT(SecondsSince(aborter.m_Aborted), 1.0 * Patience()) << name;
  EXPECT_LT(aborter.m_LongestSilence, 1.0 * Patience()) << name;
  EXPECT_FALSE(aborter.m_Falls) << name;
}

/** The filter gives right bytes after an abort. */
void
ExpectRightLabels(MedialFilter<3> & filter, const std::string & name)
{
  const Volume small = RandomBoxes({ { 13, 12, 11 } }, UnitSpacing, 8, 101);
  filter.SetInput(MakeImage<MaskImage<3>>(small));
  filter.SetThicknessMode(itk::MedialVoxelThicknessMode::Fixed);
  filter.SetThickness(3.0);
  filter.SetPseudoGeodesicBound(itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
  filter.UnsetMaximumPoreSize();
  filter.SubvoxelThicknessOff();
  filter.GenerateThicknessOff();
  filter.UpdateLargestPossibleRegion();
  const auto expected = Classify(small, 3.0, Bound::FreeSpace);
  EXPECT_TRUE(AreEqual(PixelsOf(filter.GetOutput()), expected.labels)) << name;
  EXPECT_EQ(CountsOf(&filter), expected.counts) << name;
}

/** Counts its updates; m_IsAborted aborts the work. */
class CountingProgress : public itk::MedialVoxelProgress
{
public:
  bool
  IsAborted() const override
  {
    return m_IsAborted;
  }
  void
  Advance(std::uint64_t) override
  {}
  void
  UpdateObservers() override
  {
    ++m_Updates;
    itk::MedialVoxelCheckAbort(); // of nobody
    if (m_OnUpdate)
    {
      m_OnUpdate();
    }
  }

  bool                  m_IsAborted{ false };
  int                   m_Updates{ 0 };
  std::function<void()> m_OnUpdate;
};

void
CheckFor(double seconds)
{
  for (const auto start = Clock::now(); SecondsSince(start) < seconds;)
  {
    itk::MedialVoxelCheckAbort();
  }
}
} // namespace

TEST(MedialVoxelAbortCheck, AQueueOfPathsChecks)
{
  class Aborted : public itk::MedialVoxelProgress
  {
  public:
    bool
    IsAborted() const override
    {
      return true;
    }
    void
    Advance(std::uint64_t) override
    {}
  };
  itk::MedialVoxelBucketQueue<int> queue;
  queue.Begin({ { { 8, 8, 8 } }, { { 1.0, 1.0, 1.0 } } });
  queue.Push(0, 0.0);
  Aborted                             aborted;
  const itk::MedialVoxelProgressScope scope(aborted);
  int                                 visits = 0;
  const auto                          run = [&] {
    queue.Run([](const int point) { return static_cast<double>(point); },
              [&](const int point, const double length) {
                queue.Push(point + 1, length + 1.0);
                return ++visits < 100000;
              },
              [](const double) { return false; });
  };
  EXPECT_THROW(run(), itk::MedialVoxelAborted);
  EXPECT_LE(visits, 8192);
}

TEST(MedialVoxelAbortCheck, AsksTheProgressOfTheInnermostScope)
{
  CountingProgress outer;
  CountingProgress inner;
  EXPECT_NO_THROW(itk::MedialVoxelCheckAbort());
  {
    const itk::MedialVoxelProgressScope outerScope(outer);
    {
      const itk::MedialVoxelProgressScope innerScope(inner);
      outer.m_IsAborted = true;
      EXPECT_NO_THROW(itk::MedialVoxelCheckAbort());
      inner.m_IsAborted = true;
      EXPECT_THROW(itk::MedialVoxelCheckAbort(), itk::MedialVoxelAborted);
      std::thread([] { EXPECT_NO_THROW(itk::MedialVoxelCheckAbort()); }).join();
    }
    EXPECT_THROW(itk::MedialVoxelCheckAbort(), itk::MedialVoxelAborted);
  }
  EXPECT_NO_THROW(itk::MedialVoxelCheckAbort());
}

TEST(MedialVoxelAbortCheck, ObserversRunTenTimesASecond)
{
  CountingProgress                    progress;
  const itk::MedialVoxelProgressScope scope(progress);
  CheckFor(0.65);
  EXPECT_LE(progress.m_Updates, 6);
  EXPECT_GE(progress.m_Updates, 1);
}

TEST(MedialVoxelAbortCheck, AnUpdateThatThrowsEndsTheWorkAndNoMore)
{
  CountingProgress                    progress;
  const itk::MedialVoxelProgressScope scope(progress);
  progress.m_OnUpdate = [] { throw std::runtime_error("an observer failed"); };
  EXPECT_THROW(CheckFor(5.0), std::runtime_error);
  progress.m_OnUpdate = [&] { progress.m_IsAborted = true; };
  EXPECT_THROW(CheckFor(5.0), itk::MedialVoxelAborted);
  EXPECT_EQ(progress.m_Updates, 2);
}

TEST(MedialVoxelAbortCheck, CheckersCheckNowAndThen)
{
  CheckRecorder                       recorder;
  const itk::MedialVoxelProgressScope scope(recorder);
  itk::MedialVoxelAbortChecker        counter;
  for (std::uint32_t i = 0; i < 10 * itk::MedialVoxelAbortChecker::StepsPerCheck; ++i)
  {
    counter.Count();
  }
  EXPECT_EQ(recorder.m_NumberOfRequests, 20u); // each check asks twice: before and after an update
}

TEST(MedialVoxelAbortCheck, NoKernelComputesLongWithoutACheck)
{
  for (const HardCase & hard : HardCases())
  {
    const auto filter = MedialFilter<3>::New();
    filter->SetInput(MakeImage<MaskImage<3>>(hard.volume()));
    hard.prepare(*filter);
    const double longest = FindLongestSilence(*filter, 1.5);
    EXPECT_LT(longest, 0.1 + 0.05 * Patience()) << hard.name;
    std::cout << hard.name << ": " << 1000.0 * longest << " ms" << std::endl;
  }
}

TEST(MedialVoxelAbortCheck, NoKernelOfDistancesComputesLongWithoutACheck)
{
  for (const Vector3 & spacing : { Vector3{ { 1.0, 1.0, 1.0 } }, Vector3{ { 1.0, 1.2, 1.7 } } })
  {
    Volume hollow = MakeVolume({ { 300, 260, 240 } }, spacing, [](const Index3 & v) { return v[0] + v[1] + v[2] > 3; });
    const auto filter = VectorFilter<3>::New();
    filter->SetInput(MakeImage<MaskImage<3>>(hollow));
    const double longest = FindLongestSilence(*filter, 3.0);
    EXPECT_LT(longest, 0.1 + 0.05 * Patience()) << spacing[2];
    std::cout << "distances, spacing along z " << spacing[2] << ": " << 1000.0 * longest << " ms" << std::endl;
  }
}

TEST(MedialVoxelAbortCheck, HardWorkIsAbortedWithinASecondAndTheFilterStaysUsable)
{
  for (const unsigned int units : { 1u, 2u })
  {
    for (const HardCase & hard : HardCases())
    {
      const std::string name = std::string(hard.name) + ", " + std::to_string(units) + " threads";
      auto              filter = MedialFilter<3>::New();
      filter->SetNumberOfWorkUnits(units);
      filter->SetInput(MakeImage<MaskImage<3>>(hard.volume()));
      hard.prepare(*filter);
      ExpectAbortWithinASecond(*filter, name);
      ExpectRightLabels(*filter, name);
    }
  }
}

TEST(MedialVoxelAbortCheck, DistancesAreAbortedWithinASecond)
{
  const Volume solid =
    MakeVolume({ { 400, 300, 300 } }, { { 1.0, 1.2, 1.7 } }, [](const Index3 & v) { return v[0] + v[1] + v[2] > 3; });
  for (const unsigned int units : { 1u, 2u })
  {
    auto filter = VectorFilter<3>::New();
    filter->SetNumberOfWorkUnits(units);
    filter->SetInput(MakeImage<MaskImage<3>>(solid));
    ExpectAbortWithinASecond(*filter, "distances");
  }
}

TEST(MedialVoxelAbortCheck, ASurfaceIsAbortedWithinASecondAndTheFilterStaysUsable)
{
  using MeshFilter = itk::MedialSurfaceMeshFilter<MaskImage<3>>;
  for (const unsigned int units : { 1u, 2u })
  {
    for (const bool isAutomatic : { false, true })
    {
      auto filter = MeshFilter::New();
      filter->SetNumberOfWorkUnits(units);
      filter->SetInput(MakeImage<MaskImage<3>>(Noise()));
      filter->SetThicknessMode(isAutomatic ? itk::MedialVoxelThicknessMode::Automatic
                                           : itk::MedialVoxelThicknessMode::Fixed);
      filter->SetMaximumThickness(isAutomatic ? 30.0 : 0.0);
      filter->SetThickness(40.0);
      ExpectAbortWithinASecond(*filter, "surface");
      const Volume small = AxisPlate({ { 20, 18, 16 } }, UnitSpacing, 2, 6, 4);
      filter->SetInput(MakeImage<MaskImage<3>>(small));
      filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Fixed);
      filter->SetThickness(3.0);
      filter->Update();
      auto fresh = MeshFilter::New();
      fresh->SetInput(MakeImage<MaskImage<3>>(small));
      fresh->SetThickness(3.0);
      fresh->Update();
      ASSERT_GT(fresh->GetOutput()->GetNumberOfPoints(), 0u);
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), fresh->GetOutput()->GetNumberOfPoints());
      EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), fresh->GetOutput()->GetNumberOfCells());
    }
  }
}

/** A noisy surface of thousands of sheets, whose cleaning takes longer than its tiles. */
TEST(MedialVoxelAbortCheck, CleaningASurfaceIsAbortedWithinASecond)
{
  using MeshFilter = itk::MedialSurfaceMeshFilter<MaskImage<3>>;
  auto filter = MeshFilter::New();
  filter->SetInput(MakeImage<MaskImage<3>>(RandomVolume({ { 100, 100, 100 } }, UnitSpacing, 0.5, 3)));
  filter->SetThickness(2.0);
  filter->SetMinimumBranchLength(40.0);
  filter->SetSmallestComponent(50);
  Clock::time_point done;
  Clock::time_point aborted;
  bool              isLast = false;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    // All tiles are done; what comes now is the surface as a whole.
    if (filter->GetProgress() >= 1.0f && !isLast)
    {
      isLast = true;
      aborted = Clock::now();
      filter->AbortGenerateDataOn();
    }
  });
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  EXPECT_TRUE(isLast);
  EXPECT_LT(SecondsSince(aborted), 1.0 * Patience());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0u);
}

/** As a button of a user interface does that runs the filter in a thread. */
TEST(MedialVoxelAbortCheck, AnAbortFromAnotherThreadIsHeardToo)
{
  for (const unsigned int units : { 1u, 2u })
  {
    auto filter = MakeMedialFilter<3>(Noise(), 154.0);
    filter->SetNumberOfWorkUnits(units);
    Clock::time_point aborted;
    std::thread       other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(700));
      aborted = Clock::now();
      filter->AbortGenerateDataOn();
    });
    EXPECT_THROW(filter->Update(), itk::ProcessAborted);
    other.join();
    EXPECT_LT(SecondsSince(aborted), 1.0 * Patience());
    ExpectRightLabels(*filter, "from another thread");
  }
}

TEST(MedialVoxelAbortCheck, AnObserverThatThrowsEndsTheUpdateSoon)
{
  for (const unsigned int units : { 1u, 2u })
  {
    auto filter = MakeMedialFilter<3>(Noise(), 154.0);
    filter->SetNumberOfWorkUnits(units);
    Clock::time_point start = Clock::now();
    const auto        tag = filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      if (SecondsSince(start) > 0.3)
      {
        start = Clock::now();
        throw std::runtime_error("an interrupt");
      }
    });
    EXPECT_THROW(filter->Update(), std::runtime_error);
    EXPECT_LT(SecondsSince(start), 1.0 * Patience());
    filter->RemoveObserver(tag);
    ExpectRightLabels(*filter, "after an observer that throws");
  }
}
