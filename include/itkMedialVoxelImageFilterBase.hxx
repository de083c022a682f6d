// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterBase_hxx
#define itkMedialVoxelImageFilterBase_hxx

#include "itkMath.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace itk
{

/** One execution of the filter: the engine's client, and the place where workers meet. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelImageFilterBase<TInputImage, TOutputImage>::Execution
  : public MedialVoxelClusterClient
  , public MedialVoxelProgress
{
public:
  Execution(Self & filter, MedialVoxelClusterEngine & engine, const MedialVoxelBox & region)
    : m_Filter(filter)
    , m_Engine(engine)
    , m_Predicate(filter.GetPredicate())
    , m_Region(region)
    , m_CallingThread(std::this_thread::get_id())
  {}

  void
  Run()
  {
    m_Engine.Run(m_Region, *this);
  }

  const TileSums &
  GetSums() const
  {
    return m_Sums;
  }

  void
  FillObject(const MedialVoxelBox & box, MedialVoxelBits & object, MedialVoxelBits * const notANumber) override
  {
    for (const MedialVoxelBox & piece : CutForPull(box))
    {
      this->ThrowIfAborted();
      this->Pull(piece);
      this->Pack(piece, m_Predicate, object);
      if (notANumber != nullptr)
      {
        this->Pack(piece, [](const InputPixelType value) { return value != value; }, *notANumber);
      }
    }
  }

  void
  RunTiles(MedialVoxelTileSchedule & schedule) override
  {
    m_Schedule = &schedule;
    MultiThreaderBase * const multiThreader = m_Filter.GetMultiThreader();
    const SizeValueType       mostWorkers =
      std::min<SizeValueType>(m_Filter.GetNumberOfWorkUnits(), multiThreader->GetMaximumNumberOfThreads());
    const SizeValueType workers =
      std::max<SizeValueType>(1, std::min<SizeValueType>(mostWorkers, schedule.GetNumberOfTiles()));
    multiThreader->SetNumberOfWorkUnits(static_cast<ThreadIdType>(workers));
    multiThreader->ParallelizeArray(0, workers, [this](SizeValueType) { this->Work(); }, nullptr);
    schedule.RethrowFailure();
    this->ThrowIfAborted();
  }

  /** The part of DynamicThreadedGenerateData() that needs the execution. */
  void
  ProcessTile(const MedialVoxelBox & tile)
  {
    std::unique_ptr<Workspace> workspace = this->TakeWorkspace();
    TileSums                   sums;
    const MedialVoxelBox       missing = m_Filter.ProcessTile(tile, m_Engine.GetWindow(), *this, *workspace, sums);
    if (missing.IsEmpty())
    {
      sums.counts.notANumberVoxels = m_Engine.GetWindow().GetNotANumber().Count(tile);
      this->Advance(static_cast<std::uint64_t>(tile.NumberOfVoxels()));
    }
    else
    {
      sums.counts = {};
      sums.recomputedVoxels = static_cast<std::uint64_t>(tile.NumberOfVoxels());
      m_Schedule->Defer(tile, missing);
    }
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Sums.counts += sums.counts;
    m_Sums.recomputedVoxels += sums.recomputedVoxels;
    m_Sums.distanceSeconds += sums.distanceSeconds;
    m_Sums.classificationSeconds += sums.classificationSeconds;
    m_Workspaces.push_back(std::move(workspace));
  }

  bool
  IsAborted() const override
  {
    return m_Filter.GetAbortGenerateData();
  }

  void
  Advance(const std::uint64_t voxels) override
  {
    const std::uint64_t done = m_DoneVoxels += voxels;
    // Observers are called from the thread that called Update(), as those of Python and of user interfaces must be.
    if (std::this_thread::get_id() == m_CallingThread)
    {
      m_Filter.UpdateProgress(static_cast<float>(done) / static_cast<float>(m_Region.NumberOfVoxels()));
    }
  }

  /** Pieces in which a box of input is pulled: whole slices, as many as fit a few megabytes. */
  static std::vector<MedialVoxelBox>
  CutForPull(const MedialVoxelBox & box)
  {
    constexpr std::int64_t bytesPerPull = 4 << 20;
    const std::int64_t     bytesPerRow = box.Extent(0) * static_cast<std::int64_t>(sizeof(InputPixelType));
    MedialVoxelIndex       size{ { box.upper[0], box.upper[1], box.upper[2] } };
    if (box.Extent(2) > 1)
    {
      size[2] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow * box.Extent(1)));
    }
    else if (box.Extent(1) > 1)
    {
      size[1] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow));
    }
    return MedialVoxelCutIntoTiles(box, size);
  }

private:
  void
  ThrowIfAborted() const
  {
    if (this->IsAborted())
    {
      ProcessAborted exception(__FILE__, __LINE__);
      exception.SetDescription("Filter execution was aborted by an external request");
      throw exception;
    }
  }

  void
  Work()
  {
    try
    {
      MedialVoxelBox tile;
      while (!this->IsAborted() && m_Schedule->Next(tile))
      {
        m_Filter.DynamicThreadedGenerateData(m_Filter.RegionOf(tile));
      }
    }
    catch (...)
    {
      m_Schedule->Fail(std::current_exception());
    }
  }

  std::unique_ptr<Workspace>
  TakeWorkspace()
  {
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      if (!m_Workspaces.empty())
      {
        std::unique_ptr<Workspace> workspace = std::move(m_Workspaces.back());
        m_Workspaces.pop_back();
        return workspace;
      }
    }
    return m_Filter.MakeWorkspace();
  }

  /** Have the pipeline produce a piece of the input. */
  void
  Pull(const MedialVoxelBox & piece)
  {
    auto * const               input = const_cast<InputImageType *>(m_Filter.GetInput());
    const InputImageRegionType region = m_Filter.RegionOf(piece);
    input->SetRequestedRegion(region);
    input->PropagateRequestedRegion();
    input->UpdateOutputData();
    if (!input->GetBufferedRegion().IsInside(region))
    {
      itkGenericExceptionMacro("The input image holds " << input->GetBufferedRegion() << " but " << region
                                                        << " is needed.");
    }
  }

  template <typename TPredicate>
  void
  Pack(const MedialVoxelBox & piece, const TPredicate & predicate, MedialVoxelBits & bits) const
  {
    m_Filter.ForEachRow(
      *m_Filter.GetInput(), piece, [&](const InputPixelType * const pixels, const MedialVoxelBox & row) {
        MedialVoxelPackRow(pixels,
                           row.lower[0],
                           row.Extent(0),
                           predicate,
                           bits.GetRow(row.lower[1], row.lower[2]) - bits.GetFirstWord());
      });
  }

  Self &                                  m_Filter;
  MedialVoxelClusterEngine &              m_Engine;
  PredicateType                           m_Predicate;
  MedialVoxelBox                          m_Region;
  std::thread::id                         m_CallingThread;
  MedialVoxelTileSchedule *               m_Schedule{ nullptr };
  std::atomic<std::uint64_t>              m_DoneVoxels{ 0 };
  std::mutex                              m_Mutex;
  std::vector<std::unique_ptr<Workspace>> m_Workspaces;
  TileSums                                m_Sums;
};

template <typename TInputImage, typename TOutputImage>
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::MedialVoxelImageFilterBase()
{
  this->DynamicMultiThreadingOn();
  this->ThreaderUpdateProgressOff();
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::SetLowerThreshold(const double threshold)
{
  if (!m_UseThresholds || !Math::ExactlyEquals(m_LowerThreshold, threshold))
  {
    m_UseThresholds = true;
    m_LowerThreshold = threshold;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::SetUpperThreshold(const double threshold)
{
  if (!m_UseThresholds || !Math::ExactlyEquals(m_UpperThreshold, threshold))
  {
    m_UseThresholds = true;
    m_UpperThreshold = threshold;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::UnsetThresholds()
{
  if (m_UseThresholds)
  {
    m_UseThresholds = false;
    m_LowerThreshold = -std::numeric_limits<double>::infinity();
    m_UpperThreshold = std::numeric_limits<double>::infinity();
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::UpdateOutputInformation()
{
  m_StartNewSum = true;
  Superclass::UpdateOutputInformation();
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (std::isnan(m_LowerThreshold) || std::isnan(m_UpperThreshold) || m_LowerThreshold > m_UpperThreshold)
  {
    itkExceptionMacro("The thresholds are " << m_LowerThreshold << " and " << m_UpperThreshold
                                            << "; they must be numbers, the lower one not above the upper one.");
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::VerifyInputInformation() ITKv5_CONST
{
  Superclass::VerifyInputInformation();
  const InputImageType * const input = this->GetInput();
  const SizeValueType          largestSize = std::numeric_limits<std::int32_t>::max();
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    const double spacing = input->GetSpacing()[axis];
    if (!(spacing > 0.0) || !std::isfinite(spacing))
    {
      itkExceptionMacro("The spacing along axis " << axis << " is " << spacing << "; it must be positive and finite.");
    }
    const SizeValueType size = input->GetLargestPossibleRegion().GetSize(axis);
    if (size > largestSize)
    {
      itkExceptionMacro("The size along axis " << axis << " is " << size << "; it must not exceed " << largestSize
                                               << '.');
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  auto * const input = const_cast<InputImageType *>(this->GetInput());
  if (input == nullptr)
  {
    return;
  }
  const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
  if (requested.GetNumberOfPixels() == 0)
  {
    input->SetRequestedRegion(InputImageRegionType(requested.GetIndex(), requested.GetSize()));
    return;
  }
  this->PrepareEngine(this->GetGrid());
  const auto parts = m_Engine->GetMissingObjectBoxes(this->BoxOf(requested));
  if (!parts.empty())
  {
    input->SetRequestedRegion(this->RegionOf(Execution::CutForPull(parts.front()).front()));
  }
  else
  {
    // All is in the window; what is buffered needs no work of the pipeline.
    input->SetRequestedRegion(input->GetBufferedRegion());
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::PrepareEngine(const MedialVoxelGrid & grid)
{
  const ModifiedTimeType modifiedTime = this->GetWindowMTime();
  if (m_StartNewSum || !m_Engine || modifiedTime != m_EngineMTime)
  {
    m_Engine = std::make_unique<MedialVoxelClusterEngine>(grid, this->CompleteSettings(grid));
    m_EngineMTime = modifiedTime;
  }
}

/** The settings of the derived class, with those that all filters have. */
template <typename TInputImage, typename TOutputImage>
MedialVoxelClusterEngine::Settings
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::CompleteSettings(const MedialVoxelGrid & grid) const
{
  MedialVoxelClusterEngine::Settings settings = this->GetEngineSettings(grid);
  settings.keepsNotANumber = std::is_floating_point<InputPixelType>::value;
  settings.tileSize = m_TileSize;
  settings.slabThickness = m_SlabThickness;
  return settings;
}

template <typename TInputImage, typename TOutputImage>
ModifiedTimeType
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::GetWindowMTime() const
{
  return std::max(this->GetMTime(), this->GetInput()->GetPipelineMTime());
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::GenerateData()
{
  this->AllocateOutputs();
  const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
  if (requested.GetNumberOfPixels() == 0)
  {
    return;
  }
  const MedialVoxelGrid grid = this->GetGrid();
  const MedialVoxelBox  region = this->BoxOf(requested);
  this->PrepareEngine(grid);
  this->BeforeTiles(grid);
  Execution execution(*this, *m_Engine, region);
  m_Execution = &execution;
  try
  {
    execution.Run();
  }
  catch (...)
  {
    m_Execution = nullptr;
    m_Engine.reset();
    throw;
  }
  m_Execution = nullptr;
  const unsigned int axis = MedialVoxelSlowestAxis(grid.GetVoxelBox());
  if (region.upper[axis] == grid.GetSize()[axis])
  {
    // No piece follows along the slowest axis of the image, so that nobody needs the window.
    m_Engine.reset();
  }

  const bool       isNewSum = std::exchange(m_StartNewSum, false);
  const TileSums & sums = execution.GetSums();
  m_NumberOfNotANumberVoxels = (isNewSum ? 0 : m_NumberOfNotANumberVoxels) + sums.counts.notANumberVoxels;
  m_NumberOfRecomputedVoxels = (isNewSum ? 0 : m_NumberOfRecomputedVoxels) + sums.recomputedVoxels;
  m_DistanceSeconds = (isNewSum ? 0.0 : m_DistanceSeconds) + sums.distanceSeconds;
  m_ClassificationSeconds = (isNewSum ? 0.0 : m_ClassificationSeconds) + sums.classificationSeconds;
  this->AddCounts(sums.counts, isNewSum);
  this->UpdateProgress(1.0f);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const OutputImageRegionType & region)
{
  m_Execution->ProcessTile(this->BoxOf(region));
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::AddCounts(const MedialVoxelCounts &, bool)
{}

template <typename TInputImage, typename TOutputImage>
MedialVoxelGrid
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::GetGrid() const
{
  const InputImageType * const input = this->GetInput();
  MedialVoxelIndex             size{ { 1, 1, 1 } };
  MedialVoxelGrid::SpacingType spacing{ { 1.0, 1.0, 1.0 } };
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    size[axis] = static_cast<std::int64_t>(input->GetLargestPossibleRegion().GetSize(axis));
    spacing[axis] = m_UseImageSpacing ? input->GetSpacing()[axis] : 1.0;
  }
  return { size, spacing };
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelBox
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::BoxOf(const ImageRegion<ImageDimension> & region) const
{
  const auto &   start = this->GetInput()->GetLargestPossibleRegion().GetIndex();
  MedialVoxelBox box{ { { 0, 0, 0 } }, { { 1, 1, 1 } } };
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    box.lower[axis] = region.GetIndex(axis) - start[axis];
    box.upper[axis] = box.lower[axis] + static_cast<std::int64_t>(region.GetSize(axis));
  }
  return box;
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::RegionOf(const MedialVoxelBox & box) const
  -> ImageRegion<ImageDimension>
{
  const auto &                start = this->GetInput()->GetLargestPossibleRegion().GetIndex();
  ImageRegion<ImageDimension> region;
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    region.SetIndex(axis, static_cast<IndexValueType>(box.lower[axis]) + start[axis]);
    region.SetSize(axis, static_cast<SizeValueType>(box.Extent(axis)));
  }
  return region;
}

template <typename TInputImage, typename TOutputImage>
template <typename TImage, typename TFunction>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::ForEachRow(TImage &               image,
                                                                  const MedialVoxelBox & tile,
                                                                  TFunction &&           function) const
{
  MedialVoxelBox row = tile;
  for (std::int64_t z = tile.lower[2]; z < tile.upper[2]; ++z)
  {
    row.lower[2] = z;
    row.upper[2] = z + 1;
    for (std::int64_t y = tile.lower[1]; y < tile.upper[1]; ++y)
    {
      row.lower[1] = y;
      row.upper[1] = y + 1;
      function(image.GetBufferPointer() + image.ComputeOffset(this->RegionOf(row).GetIndex()), row);
    }
  }
}

template <typename TInputImage, typename TOutputImage>
template <typename TVectorImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::WriteVectors(TVectorImage &              image,
                                                                    const MedialVoxelBox &      tile,
                                                                    const MedialVoxelFeatures & features) const
{
  const MedialVoxelDisplacementWriter<TVectorImage> toVector(image, m_UseImageSpacing);
  this->ForEachRow(image, tile, [&](typename TVectorImage::PixelType * target, const MedialVoxelBox & row) {
    const std::size_t offset = features.OffsetOf(row.lower[0], row.lower[1], row.lower[2]);
    for (std::int64_t i = 0; i < row.Extent(0); ++i)
    {
      target[i] = toVector(features, offset + static_cast<std::size_t>(i));
    }
  });
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::GetPredicate() const -> PredicateType
{
  return m_UseThresholds ? PredicateType::InRange(m_LowerThreshold, m_UpperThreshold)
                         : PredicateType::DifferentFrom(m_BackgroundValue);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent
     << "BackgroundValue: " << static_cast<typename NumericTraits<InputPixelType>::PrintType>(m_BackgroundValue)
     << std::endl;
  os << indent << "LowerThreshold: " << m_LowerThreshold << std::endl;
  os << indent << "UpperThreshold: " << m_UpperThreshold << std::endl;
  os << indent << "UseThresholds: " << (m_UseThresholds ? "On" : "Off") << std::endl;
  os << indent << "UseImageSpacing: " << (m_UseImageSpacing ? "On" : "Off") << std::endl;
  os << indent << "TileSize: " << m_TileSize << std::endl;
  os << indent << "SlabThickness: " << m_SlabThickness << std::endl;
  os << indent << "NumberOfNotANumberVoxels: " << m_NumberOfNotANumberVoxels << std::endl;
  os << indent << "NumberOfRecomputedVoxels: " << m_NumberOfRecomputedVoxels << std::endl;
  os << indent << "DistanceSeconds: " << m_DistanceSeconds << std::endl;
  os << indent << "ClassificationSeconds: " << m_ClassificationSeconds << std::endl;
}

} // end namespace itk

#endif
