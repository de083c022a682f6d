// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Where the threads of an update run the phases, and a caller those of one region.

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialVoxelImageFilter.h"

#include "MedialVoxelTestRuns.h"

#include "itkImageRegionConstIteratorWithIndex.h"

#include <atomic>

namespace
{
using namespace MedialVoxelTest;

/** Counts the threads that run the phases, and lets a test run those of one region. */
class EnteredFilter : public MedialFilter<3>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(EnteredFilter);

  using Self = EnteredFilter;
  using Superclass = MedialFilter<3>;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  using Superclass::AllocateOutputs;

  void
  DynamicThreadedGenerateData(const OutputImageRegionType & region) override
  {
    ++m_NumberOfCalls;
    Superclass::DynamicThreadedGenerateData(region);
  }

  std::atomic<int> m_NumberOfCalls{ 0 };

protected:
  EnteredFilter() = default;
};

itk::SmartPointer<EnteredFilter>
MakeEnteredFilter()
{
  auto filter = EnteredFilter::New();
  filter->SetInput(MakeImage<MaskImage<3>>(RandomBoxes({ { 14, 12, 11 } }, { { 0.8, 0.9, 1.2 } }, 9, 81)));
  filter->SetNumberOfWorkUnits(3);
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 6);
  return filter;
}
} // namespace

TEST(MedialVoxelThreads, EachThreadOfAnUpdateIsInDynamicThreadedGenerateData)
{
  const auto filter = MakeEnteredFilter();
  filter->GetMultiThreader()->SetMaximumNumberOfThreads(3);
  filter->Update();
  EXPECT_GE(filter->m_NumberOfCalls, 3);
}

TEST(MedialVoxelThreads, DynamicThreadedGenerateDataRunsThePhasesOfARegion)
{
  const auto whole = MakeEnteredFilter();
  whole->Update();
  const auto filter = MakeEnteredFilter();
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegionToLargestPossibleRegion();
  filter->AllocateOutputs();
  filter->GetOutput()->FillBuffer(9);
  auto region = filter->GetOutput()->GetLargestPossibleRegion();
  region.SetIndex(2, 3);
  region.SetSize(2, 5);
  filter->DynamicThreadedGenerateData(region);
  itk::ImageRegionConstIteratorWithIndex<MedialFilter<3>::OutputImageType> label(
    filter->GetOutput(), filter->GetOutput()->GetLargestPossibleRegion());
  for (; !label.IsAtEnd(); ++label)
  {
    const auto index = label.GetIndex();
    ASSERT_EQ(label.Get(), region.IsInside(index) ? whole->GetOutput()->GetPixel(index) : 9) << index;
  }
  EXPECT_EQ(CountsOf(filter.GetPointer()), Counts());
}
