// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterClient_hxx
#define itkMedialVoxelImageFilterClient_hxx

#include "itkMedialVoxelImageFilterBase.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelRows.h"
#include "itkMedialVoxelSmoothing.h"
#include "itkMultiThreaderBase.h"

#include <exception>
#include <functional>
#include <type_traits>
#include <vector>

namespace itk
{

/** What the engine gets from the filter: bits of the input, threads, and places for the results. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelImageFilterBase<TInputImage, TOutputImage>::Client : public MedialVoxelEngineClient
{
public:
  Client(Self & filter, const unsigned int run, const unsigned int numberOfRuns)
    : m_Filter(filter)
    , m_Predicate(filter.GetPredicate())
    , m_IsSmoothed(filter.SmoothsObject())
    , m_Objects(filter.GetObjectMap())
    , m_Run(run)
    , m_NumberOfRuns(numberOfRuns)
  {}

  /** Pipelines run in the thread of the update; an image without one lies in memory for all to read. */
  MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_Filter.GetInput()->GetSource() == nullptr ? MedialVoxelSourceThreads::Several
                                                       : MedialVoxelSourceThreads::Calling;
  }

  std::int64_t
  GetRowsReadTogether() const override
  {
    return m_IsSmoothed ? MedialVoxelSmoothingNumbers::RowsOfStrip : 1;
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
    m_Filter.ForEachPart(box, [&](const MedialVoxelBox & part, const InputPixelType * const first) {
      MedialVoxelCopyBox(first, this->Strides(), part, gray);
    });
  }

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
  IsAbortRequested() const override
  {
    return m_Filter.GetAbortGenerateData();
  }

  std::exception_ptr
  GetAbortException() const override
  {
    return MakeAbortException();
  }

  static std::vector<MedialVoxelBox>
  CutForPull(const MedialVoxelBox & box)
  {
    return MedialVoxelEngineClient::CutForPull(box, sizeof(InputPixelType));
  }

private:
  void
  Fill(const MedialVoxelBox &  box,
       MedialVoxelBits &       object,
       MedialVoxelBits * const notANumber,
       MedialVoxelGray * const gray)
  {
    // Each run over the same region sees the same voxels, which count once.
    MedialVoxelBits * const counted = m_Run == 0 ? notANumber : nullptr;
    if (m_IsSmoothed)
    {
      this->FillSmoothed(box, object, counted, gray);
      return;
    }
    m_Filter.ForEachPart(box, [&](const MedialVoxelBox & part, const InputPixelType * const first) {
      this->FillObjectOfPart(part, first, object);
      this->FillValuesOfPart(part, first, counted, gray);
    });
  }

  /** Each strip of the box is pulled with its margin. */
  void
  FillSmoothed(const MedialVoxelBox &  box,
               MedialVoxelBits &       object,
               MedialVoxelBits * const notANumber,
               MedialVoxelGray * const gray)
  {
    const InputImageType & input = *m_Filter.GetInput();
    const MedialVoxelBox   image = m_Filter.GetGrid().GetVoxelBox();
    const auto             fill = [&](const auto & rule) {
      MedialVoxelSmoother<InputPixelType, std::decay_t<decltype(rule)>> smoother(image, rule);
      MedialVoxelForEachStrip(box, MedialVoxelSmoothingNumbers::RowsOfStrip, [&](const MedialVoxelBox & part) {
        MedialVoxelPoll();
        const MedialVoxelBox margin = MedialVoxelSmoothingNumbers::GetInputBox(part, image);
        m_Filter.Pull(margin);
        smoother.Run(m_Filter.FirstPixelOf(input, margin), this->Strides(), part, object);
        this->FillValuesOfPart(part, m_Filter.FirstPixelOf(input, part), notANumber, gray);
      });
    };
    MedialVoxelWithSmoothingRule(m_Predicate, m_Filter.GetLowerLimit(), m_Filter.GetUpperLimit(), fill);
  }

  void
  FillValuesOfPart(const MedialVoxelBox &       part,
                   const InputPixelType * const first,
                   MedialVoxelBits * const      notANumber,
                   MedialVoxelGray * const      gray) const
  {
    if (notANumber != nullptr)
    {
      const auto isNotANumber = [](const InputPixelType value) { return value != value; };
      MedialVoxelPackBox(first, this->Strides(), part, isNotANumber, *notANumber);
    }
    if (gray != nullptr)
    {
      MedialVoxelCopyBox(first, this->Strides(), part, *gray);
    }
  }

  void
  FillObjectOfPart(const MedialVoxelBox & part, const InputPixelType * const first, MedialVoxelBits & object) const
  {
    if (m_Objects == nullptr)
    {
      MedialVoxelPackBox(first, this->Strides(), part, m_Predicate, object);
      return;
    }
    std::vector<MedialVoxelObjectNumber> numbers(static_cast<std::size_t>(part.Extent(0)));
    MedialVoxelForEachRow(part, this->Strides(), [&](const std::int64_t offset, const MedialVoxelBox & row) {
      m_Objects->GetTable().Translate(first + offset, numbers.size(), numbers.data());
      const auto isShown = [this](const MedialVoxelObjectNumber number) { return m_Objects->IsShown(number); };
      MedialVoxelPackBox(numbers.data(), {}, row, isShown, object);
    });
  }

  MedialVoxelStrides
  Strides() const
  {
    return Self::StridesOf(*m_Filter.GetInput());
  }

  Self &                       m_Filter;
  PredicateType                m_Predicate;
  bool                         m_IsSmoothed;
  const MedialVoxelObjectMap * m_Objects;
  unsigned int                 m_Run;
  unsigned int                 m_NumberOfRuns;
};

/** Lets a pass before the extraction be stopped. Its progress is that of the begin. */
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
    return m_Client.IsAbortRequested();
  }

  void
  Advance(std::uint64_t) override
  {}

  void
  Beat() override
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
