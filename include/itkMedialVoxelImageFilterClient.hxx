// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterClient_hxx
#define itkMedialVoxelImageFilterClient_hxx

#include "itkMedialVoxelImageFilterBase.h"

#include "itkMedialVoxelProgress.h"
#include "itkMultiThreaderBase.h"

#include <exception>
#include <functional>

namespace itk
{

/** The pixels of the input, which the pipeline produces. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelImageFilterBase<TInputImage, TOutputImage>::Source : public MedialVoxelValueSource
{
public:
  explicit Source(Self & filter)
    : m_Filter(filter)
  {}

  MedialVoxelValueType
  GetValueType() const override
  {
    return MedialVoxelGetValueType<InputPixelType>();
  }

  /** Pipelines run in the thread of the update; an image without one lies in memory for all to read. */
  MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_Filter.GetInput()->GetSource() == nullptr ? MedialVoxelSourceThreads::Several
                                                       : MedialVoxelSourceThreads::Calling;
  }

  void
  WithBox(const MedialVoxelBox & box, const ViewFunction & function) override
  {
    m_Filter.Pull(box);
    const InputImageType & input = *m_Filter.GetInput();
    function({ m_Filter.FirstPixelOf(input, box), Self::StridesOf(input) });
  }

private:
  Self & m_Filter;
};

/** Gives the engine the threads and outputs of the filter. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelImageFilterBase<TInputImage, TOutputImage>::Client : public MedialVoxelEngineClient
{
public:
  Client(Self & filter, const unsigned int run, const unsigned int numberOfRuns)
    : m_Filter(filter)
    , m_Run(run)
    , m_NumberOfRuns(numberOfRuns)
  {}

  void
  RunWorkers(const unsigned int numberOfWorkers, const std::function<void()> & work) override
  {
    MultiThreaderBase * const multiThreader = m_Filter.GetMultiThreader();
    multiThreader->SetNumberOfWorkUnits(static_cast<ThreadIdType>(numberOfWorkers));
    const OutputImageRegionType region = m_Filter.GetOutput()->GetRequestedRegion();
    m_Filter.m_Work = work;
    multiThreader->ParallelizeArray(
      0, numberOfWorkers, [&](SizeValueType) { m_Filter.DynamicThreadedGenerateData(region); }, nullptr);
    m_Filter.m_Work = nullptr;
  }

  void
  TakeTile(const MedialVoxelTileResult & tile) override
  {
    m_Filter.TakeTile(tile);
  }

  void
  UpdateProgress(const float fraction) override
  {
    m_Filter.UpdateProgress((static_cast<float>(m_Run) + fraction) / static_cast<float>(m_NumberOfRuns));
  }

  bool
  IsAborted() const override
  {
    return m_Filter.GetAbortGenerateData();
  }

  std::exception_ptr
  GetAbortException() const override
  {
    return MakeAbortException();
  }

private:
  Self &       m_Filter;
  unsigned int m_Run;
  unsigned int m_NumberOfRuns;
};

/** Lets a pass before the extraction be aborted. Progress stays 0. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelImageFilterBase<TInputImage, TOutputImage>::PassProgress : public MedialVoxelProgress
{
public:
  explicit PassProgress(Client & client)
    : m_Client(client)
  {}

  bool
  IsAborted() const override
  {
    return m_Client.IsAborted();
  }

  void
  Advance(std::uint64_t) override
  {}

  void
  UpdateObservers() override
  {
    m_Client.UpdateProgress(0.0f);
  }

  [[noreturn]] void
  ThrowAborted() const override
  {
    std::rethrow_exception(m_Client.GetAbortException());
  }

private:
  Client & m_Client;
};

} // end namespace itk

#endif
