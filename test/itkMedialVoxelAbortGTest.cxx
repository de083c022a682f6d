// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Progress and abort (invariant I11), and failures of the input or of a worker while the filter runs.

#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkCommand.h"
#include "itkStreamingImageFilter.h"

#include <atomic>
#include <chrono>
#include <stdexcept>

namespace
{
using namespace MedialVoxelTest;

/** A volume that takes several seconds at this thickness, so that an abort has something to stop. */
Volume
LongWork()
{
  return RandomVolume({ { 160, 160, 120 } }, { { 1.0, 1.1, 1.2 } }, 0.75, 7);
}

const double LongThickness = 12.0;

/** Sets the abort flag at the first progress event that reaches a fraction, and remembers when. */
class Aborter : public itk::Command
{
public:
  using Self = Aborter;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  void
  Execute(itk::Object * caller, const itk::EventObject &) override
  {
    auto * filter = dynamic_cast<itk::ProcessObject *>(caller);
    if (filter->GetProgress() >= m_Fraction && !m_HasAborted)
    {
      m_HasAborted = true;
      m_Time = std::chrono::steady_clock::now();
      filter->AbortGenerateDataOn();
    }
  }
  void
  Execute(const itk::Object *, const itk::EventObject &) override
  {}

  float                                 m_Fraction{ 0.0f };
  bool                                  m_HasAborted{ false };
  std::chrono::steady_clock::time_point m_Time;
};

/** A filter whose workers fail at the given tile, or before. */
class FailingFilter : public MedialFilter<3>
{
public:
  using Self = FailingFilter;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  std::atomic<int> m_TilesLeft{ 5 };
  bool             m_FailsAtOnce{ false };

protected:
  void
  DynamicThreadedGenerateData(const OutputImageRegionType & region) override
  {
    if (m_FailsAtOnce)
    {
      throw std::runtime_error("no luck at all");
    }
    MedialFilter<3>::DynamicThreadedGenerateData(region);
  }

  void
  TakeTile(const itk::MedialVoxelTileResult & tile) override
  {
    if (m_TilesLeft-- <= 0)
    {
      throw std::runtime_error("out of luck");
    }
    MedialFilter<3>::TakeTile(tile);
  }
};

/** An image source that fails at the given request. */
class FailingSource : public RecordingSource<MaskImage<3>>
{
public:
  using Self = FailingSource;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  std::size_t m_FailAt{ 1000000 };

protected:
  void
  GenerateData() override
  {
    if (this->GetRequests().size() >= m_FailAt)
    {
      itkExceptionMacro("the disk is on fire");
    }
    RecordingSource<MaskImage<3>>::GenerateData();
  }
};
/** An image source that holds back the last slice of what it is asked for. */
class ShortSource : public RecordingSource<MaskImage<3>>
{
public:
  using Self = ShortSource;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

protected:
  void
  GenerateData() override
  {
    auto region = this->GetOutput()->GetRequestedRegion();
    region.SetSize(2, region.GetSize(2) - 1);
    this->GetOutput()->SetBufferedRegion(region);
    this->GetOutput()->Allocate(true);
  }
};
} // namespace

TEST(MedialVoxelAbort, StopsWithinASecondAndLeavesTheFilterUsable)
{
  const Volume volume = LongWork();
  auto         filter = MakeMedialFilter<3>(volume, LongThickness);
  auto         aborter = Aborter::New();
  aborter->m_Fraction = 0.02f;
  const auto tag = filter->AddObserver(itk::ProgressEvent(), aborter);
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  const std::chrono::duration<double> delay = std::chrono::steady_clock::now() - aborter->m_Time;
  ASSERT_TRUE(aborter->m_HasAborted);
  EXPECT_LT(delay.count(), 1.0);
  EXPECT_EQ(CountsOf(filter.GetPointer()), Counts());

  filter->RemoveObserver(tag);
  const Volume small = RandomBoxes({ { 13, 12, 11 } }, UnitSpacing, 8, 101);
  filter->SetInput(MakeImage<MaskImage<3>>(small));
  filter->SetThickness(3.0);
  filter->UpdateLargestPossibleRegion();
  const auto expected = Classify(small, 3.0, Bound::FreeSpace);
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected.labels));
  EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
}

TEST(MedialVoxelAbort, StopsTheVectorFilterToo)
{
  auto filter = VectorFilter<3>::New();
  filter->SetInput(MakeImage<MaskImage<3>>(LongWork()));
  auto aborter = Aborter::New();
  aborter->m_Fraction = 0.01f;
  const auto tag = filter->AddObserver(itk::ProgressEvent(), aborter);
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  const std::chrono::duration<double> delay = std::chrono::steady_clock::now() - aborter->m_Time;
  EXPECT_LT(delay.count(), 1.0);
  filter->RemoveObserver(tag);
  const Volume small = RandomBoxes({ { 13, 12, 11 } }, UnitSpacing, 8, 102);
  filter->SetInput(MakeImage<MaskImage<3>>(small));
  filter->UpdateLargestPossibleRegion();
  const std::vector<unsigned char> everywhere(small.object.size(), 1);
  EXPECT_TRUE(VectorsAreEqual(PixelsOf(filter->GetOutput()),
                              ExpectedVectors<3>(small, BoundarySites(small, BoundarySide::Object), everywhere)));
}

TEST(MedialVoxelAbort, AnAbortedPieceAddsNothingAndTheSamePieceCanBeRunAgain)
{
  const Volume volume = RandomBoxes({ { 40, 38, 36 } }, UnitSpacing, 30, 103);
  auto         filter = MakeMedialFilter<3>(volume, 3.0);
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 8);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 4);
  const auto runPiece = [&](itk::IndexValueType z, itk::SizeValueType depth) {
    filter->GetOutput()->SetRequestedRegion(itk::ImageRegion<3>({ { 0, 0, z } }, { { 40, 38, depth } }));
    filter->GetOutput()->PropagateRequestedRegion();
    filter->GetOutput()->UpdateOutputData();
  };
  filter->UpdateOutputInformation();
  runPiece(0, 12);
  const Counts first = CountsOf(filter.GetPointer());
  auto         aborter = Aborter::New();
  aborter->m_Fraction = 0.3f;
  const auto tag = filter->AddObserver(itk::ProgressEvent(), aborter);
  EXPECT_THROW(runPiece(12, 24), itk::ProcessAborted);
  EXPECT_EQ(CountsOf(filter.GetPointer()), first);
  filter->RemoveObserver(tag);
  filter->UpdateOutputInformation(); // as every Update() does; it starts a new sum
  runPiece(12, 24);
  runPiece(0, 12);
  EXPECT_EQ(CountsOf(filter.GetPointer()), RunMedialFilter<3>(volume, 3.0).counts);
}

TEST(MedialVoxelAbort, AnAbortedPieceIsNotTakenForValidOutput)
{
  const Volume volume = RandomBoxes({ { 40, 38, 36 } }, UnitSpacing, 30, 105);
  auto         filter = MakeMedialFilter<3>(volume, 3.0);
  filter->GenerateVectorDistanceOn();
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 8);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 4);
  auto aborter = Aborter::New();
  aborter->m_Fraction = 0.3f;
  const auto tag = filter->AddObserver(itk::ProgressEvent(), aborter);
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegionToLargestPossibleRegion();
  filter->GetOutput()->PropagateRequestedRegion();
  EXPECT_THROW(filter->GetOutput()->UpdateOutputData(), itk::ProcessAborted);
  for (const auto & output : filter->GetOutputs())
  {
    EXPECT_EQ(dynamic_cast<itk::ImageBase<3> *>(output.GetPointer())->GetBufferedRegion().GetNumberOfPixels(), 0u);
  }
  filter->RemoveObserver(tag);

  // The same region again, without the UpdateOutputInformation() that would mark the output as outdated.
  filter->GetOutput()->SetRequestedRegionToLargestPossibleRegion();
  filter->GetOutput()->PropagateRequestedRegion();
  filter->GetOutput()->UpdateOutputData();
  const auto expected = Classify(volume, 3.0, Bound::FreeSpace);
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected.labels));
  EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
}

TEST(MedialVoxelAbort, ProgressRisesToOne)
{
  auto               filter = MakeMedialFilter<3>(RandomBoxes({ { 50, 40, 45 } }, UnitSpacing, 25, 104), 3.0);
  std::vector<float> progress;
  // Only the calling thread reports, of the tiles that it did.
  filter->SetNumberOfWorkUnits(1);
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 10);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 10);
  filter->AddObserver(itk::ProgressEvent(),
                      [&](const itk::EventObject &) { progress.push_back(filter->GetProgress()); });
  filter->Update();
  ASSERT_GT(progress.size(), 3u);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_GE(progress.front(), 0.0f);
  EXPECT_FLOAT_EQ(progress.back(), 1.0f);
  EXPECT_FLOAT_EQ(filter->GetProgress(), 1.0f);
}

TEST(MedialVoxelAbort, AnObserverThatThrowsIsNotCalledAgain)
{
  auto filter = MakeMedialFilter<3>(LongWork(), LongThickness);
  filter->SetNumberOfWorkUnits(4);
  unsigned int calls = 0;
  filter->AddObserver(itk::ProgressEvent(), [&calls](const itk::EventObject &) {
    ++calls;
    throw std::runtime_error("not today");
  });
  EXPECT_THROW(filter->Update(), std::runtime_error);
  EXPECT_EQ(calls, 1u);
}

TEST(MedialVoxelAbort, AFailingWorkerFailsTheUpdateAndNoMore)
{
  const Volume volume = RandomBoxes({ { 40, 38, 36 } }, UnitSpacing, 30, 105);
  auto         filter = FailingFilter::New();
  filter->SetInput(MakeImage<MaskImage<3>>(volume));
  filter->SetThickness(3.0);
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 10);
  for (const unsigned int units : { 1u, 4u })
  {
    filter->SetNumberOfWorkUnits(units);
    filter->m_TilesLeft = 5;
    EXPECT_THROW(filter->Update(), std::exception) << units << " work units";
    EXPECT_EQ(CountsOf(filter.GetPointer()), Counts());
    filter->m_TilesLeft = 1000000;
    filter->m_FailsAtOnce = true;
    EXPECT_THROW(filter->Update(), std::exception) << units << " work units";
    EXPECT_EQ(CountsOf(filter.GetPointer()), Counts());
    filter->m_FailsAtOnce = false;
  }
  filter->Modified();
  filter->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), RunMedialFilter<3>(volume, 3.0).labels));
}

TEST(MedialVoxelAbort, AFailingInputFailsTheUpdateAndNoMore)
{
  const Volume volume = AxisPlate({ { 12, 11, 60 } }, UnitSpacing, 0, 4, 3);
  auto         source = FailingSource::New();
  source->SetImage(MakeImage<MaskImage<3>>(volume));
  auto filter = MedialFilter<3>::New();
  filter->SetInput(source->GetOutput());
  filter->SetThickness(3.0);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 6);
  for (const std::size_t failAt : { 0, 3 })
  {
    source->ClearRequests();
    source->m_FailAt = failAt;
    source->Modified();
    EXPECT_THROW(filter->UpdateLargestPossibleRegion(), itk::ExceptionObject) << "request " << failAt;
    EXPECT_EQ(CountsOf(filter.GetPointer()), Counts());
    filter->ResetPipeline(); // ITK asks for it after an exception of an upstream filter
  }
  source->m_FailAt = 1000000;
  source->Modified();
  filter->UpdateLargestPossibleRegion();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), RunMedialFilter<3>(volume, 3.0).labels));
}

TEST(MedialVoxelAbort, AnInputThatHoldsTooLittleIsAnError)
{
  auto source = ShortSource::New();
  source->SetImage(MakeImage<MaskImage<3>>(AxisPlate({ { 12, 11, 20 } }, UnitSpacing, 0, 4, 3)));
  auto filter = MedialFilter<3>::New();
  filter->SetInput(source->GetOutput());
  EXPECT_THROW(filter->UpdateLargestPossibleRegion(), itk::ExceptionObject);
}
