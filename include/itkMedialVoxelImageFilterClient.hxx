// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterClient_hxx
#define itkMedialVoxelImageFilterClient_hxx

#include "itkMedialVoxelImageFilterBase.h"

#include "itkMedialVoxelProgress.h"
#include "itkMultiThreaderBase.h"

#include <exception>
#include <functional>
#include <vector>

namespace itk
{

/** What the engine gets from the filter: bits of the input, threads, and places for the results. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelImageFilterBase<TInputImage, TOutputImage>::Client : public MedialVoxelEngineClient
{
public:
  explicit Client(Self & filter)
    : m_Filter(filter)
    , m_Predicate(filter.GetPredicate())
  {}

  /** Pipelines run in the thread of the update; an image without one lies in memory for all to read. */
  MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_Filter.GetInput()->GetSource() == nullptr ? MedialVoxelSourceThreads::Several
                                                       : MedialVoxelSourceThreads::Calling;
  }

  void
  FillObject(const MedialVoxelBox & box, MedialVoxelBits & object, MedialVoxelBits * const notANumber) override
  {
    this->Fill(box, object, notANumber, nullptr);
  }

  void
  FillObjectAndGray(const MedialVoxelBox &  box,
                    MedialVoxelBits &       object,
                    MedialVoxelBits * const notANumber,
                    MedialVoxelGray &       gray) override
  {
    this->Fill(box, object, notANumber, &gray);
  }

  void
  FillGray(const MedialVoxelBox & box, MedialVoxelGray & gray) override
  {
    for (const MedialVoxelBox & part : CutForPull(box))
    {
      MedialVoxelPoll();
      this->Pull(part);
      MedialVoxelCopyBox(this->FirstPixelOf(part), this->Strides(), part, gray);
    }
  }

  void
  RunWorkers(const unsigned int numberOfWorkers, const std::function<void()> & work) override
  {
    MultiThreaderBase * const multiThreader = m_Filter.GetMultiThreader();
    multiThreader->SetNumberOfWorkUnits(static_cast<ThreadIdType>(numberOfWorkers));
    multiThreader->ParallelizeArray(0, numberOfWorkers, [&work](SizeValueType) { work(); }, nullptr);
  }

  void
  RunTile(const MedialVoxelBox & tile) override
  {
    m_Filter.DynamicThreadedGenerateData(m_Filter.RegionOf(tile));
  }

  void
  TakeTile(const MedialVoxelTileResult & tile) override
  {
    m_Filter.TakeTile(tile);
  }

  void
  UpdateProgress(const float fraction) override
  {
    m_Filter.UpdateProgress(fraction);
  }

  bool
  IsAbortRequested() const override
  {
    return m_Filter.GetAbortGenerateData();
  }

  std::exception_ptr
  GetAbortException() const override
  {
    ProcessAborted exception(__FILE__, __LINE__);
    exception.SetDescription("Filter execution was aborted by an external request");
    return std::make_exception_ptr(exception);
  }

  static std::vector<MedialVoxelBox>
  CutForPull(const MedialVoxelBox & box)
  {
    return MedialVoxelEngineClient::CutForPull(box, sizeof(InputPixelType));
  }

private:
  /** Have the pipeline produce a part of the input. */
  void
  Pull(const MedialVoxelBox & part)
  {
    auto * const               input = const_cast<InputImageType *>(m_Filter.GetInput());
    const InputImageRegionType region = m_Filter.RegionOf(part);
    if (this->GetSourceThreads() == MedialVoxelSourceThreads::Calling)
    {
      input->SetRequestedRegion(region);
      input->PropagateRequestedRegion();
      input->UpdateOutputData();
    }
    if (!input->GetBufferedRegion().IsInside(region))
    {
      itkGenericExceptionMacro("The input image holds " << input->GetBufferedRegion() << " but " << region
                                                        << " is needed.");
    }
  }

  void
  Fill(const MedialVoxelBox &  box,
       MedialVoxelBits &       object,
       MedialVoxelBits * const notANumber,
       MedialVoxelGray * const gray)
  {
    for (const MedialVoxelBox & part : CutForPull(box))
    {
      MedialVoxelPoll();
      this->Pull(part);
      const InputPixelType * const first = this->FirstPixelOf(part);
      MedialVoxelPackBox(first, this->Strides(), part, m_Predicate, object);
      if (notANumber != nullptr)
      {
        MedialVoxelPackBox(
          first, this->Strides(), part, [](const InputPixelType value) { return value != value; }, *notANumber);
      }
      if (gray != nullptr)
      {
        MedialVoxelCopyBox(first, this->Strides(), part, *gray);
      }
    }
  }

  const InputPixelType *
  FirstPixelOf(const MedialVoxelBox & part) const
  {
    return m_Filter.FirstPixelOf(*m_Filter.GetInput(), part);
  }

  MedialVoxelStrides
  Strides() const
  {
    return Self::StridesOf(*m_Filter.GetInput());
  }

  Self &        m_Filter;
  PredicateType m_Predicate;
};

} // end namespace itk

#endif
