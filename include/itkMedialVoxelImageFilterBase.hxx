// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterBase_hxx
#define itkMedialVoxelImageFilterBase_hxx

#include "itkMedialVoxelImageFilterClient.hxx"

#include "itkMedialVoxelGridLimits.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::MedialVoxelImageFilterBase()
  : m_Source(std::make_unique<Source>(*this))
{
  this->DynamicMultiThreadingOn();
  this->ThreaderUpdateProgressOff();
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::~MedialVoxelImageFilterBase() = default;

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::UpdateOutputInformation()
{
  m_StartNewSum = true;
  Superclass::UpdateOutputInformation();
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::VerifyInputInformation() const
{
  Superclass::VerifyInputInformation();
  const InputImageType * const input = this->GetInput();
  std::vector<std::uint64_t>   size;
  std::vector<double>          spacing;
  std::vector<double>          origin;

  std::vector<std::vector<double>> axes;
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    const auto direction = input->GetDirection().GetVnlMatrix().get_column(axis);
    axes.emplace_back(direction.begin(), direction.end());
    size.push_back(input->GetLargestPossibleRegion().GetSize(axis));
    spacing.push_back(input->GetSpacing()[axis]);
    origin.push_back(input->GetOrigin()[axis]);
  }
  const std::string problem = MedialVoxelGridLimits::FindProblem(size, spacing, origin);
  if (!problem.empty())
  {
    itkExceptionMacro("The input cannot be measured: " << problem << '.');
  }
  const std::string shear = MedialVoxelGridLimits::FindShear(axes);
  if (!shear.empty())
  {
    itkWarningMacro(<< "Lengths of the input are measured as if its grid were straight: " << shear << '.');
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
  const auto parts = MedialVoxelWithItkErrors([&] {
    this->PrepareEngine(this->GetGrid());
    return m_Engine->GetMissingObjectBoxes(this->BoxOf(requested));
  });
  if (!parts.empty())
  {
    const auto pulls = MedialVoxelValueSource::CutForPull(parts.front(), sizeof(InputPixelType));
    input->SetRequestedRegion(this->RegionOf(pulls.front()));
  }
  else
  {
    // All is in the window; buffered pixels need no work of the pipeline.
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
    m_Engine = std::make_unique<MedialVoxelEngine>(grid, this->GetEngineSettings(grid));
    m_EngineMTime = modifiedTime;
  }
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelEngineSettings
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::GetEngineSettings(const MedialVoxelGrid & grid) const
{
  MedialVoxelEngineSettings settings;
  settings.task = this->GetTask(grid);
  settings.countsNotANumber = std::is_floating_point<InputPixelType>::value;
  settings.tileSize = m_TileSize;
  settings.slabThickness = m_SlabThickness;
  settings.memoryLimit = this->GetWorkingMemoryLimit();
  settings.numberOfWorkers = this->GetNumberOfWorkers();
  return settings;
}

template <typename TInputImage, typename TOutputImage>
unsigned int
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::GetNumberOfWorkers() const
{
  return std::min(this->GetNumberOfWorkUnits(), this->GetMultiThreader()->GetMaximumNumberOfThreads());
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
  this->ReleaseSmallOutputs();
  this->AllocateOutputs();
  const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
  if (requested.GetNumberOfPixels() == 0)
  {
    return;
  }
  const MedialVoxelBox region = this->BoxOf(requested);
  MedialVoxelSums      sums;
  try
  {
    sums = MedialVoxelWithItkErrors([&] { return this->RunRegion(region); });
  }
  catch (...)
  {
    m_Engine.reset();
    m_Work = nullptr;
    // A half written buffer must not count as up to date when the same region is requested again.
    for (const auto & output : this->GetOutputs())
    {
      output->ReleaseData();
    }
    throw;
  }
  if (m_Engine && m_Engine->IsLast(region))
  {
    // Nobody needs the window.
    this->DropWindow();
  }
  const bool isNew = std::exchange(m_StartNewSum, false);
  if (isNew)
  {
    m_Sums = {};
  }
  m_Sums += sums;
  this->KeepSums(isNew);
  this->UpdateProgress(1.0f);
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelSums
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::RunRegion(const MedialVoxelBox & region)
{
  this->PrepareInput();
  return this->RunEngine(region);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::KeepSums(bool)
{}

template <typename TInputImage, typename TOutputImage>
MedialVoxelSums
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::RunEngine(const MedialVoxelBox & region,
                                                                 const unsigned int     run,
                                                                 const unsigned int     numberOfRuns)
{
  this->PrepareEngine(this->GetGrid());
  Client client(*this, run, numberOfRuns);
  return m_Engine->Run(region, *m_Input, client);
}

template <typename TInputImage, typename TOutputImage>
std::unique_ptr<MedialVoxelInput>
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::MakeInput(MedialVoxelValueSource & source)
{
  return std::make_unique<MedialVoxelObjectInput>(
    source, this->GetGrid().GetVoxelBox(), this->GetObjectRule(), MedialVoxelEnums::Smoothing::Off);
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelInput &
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::PrepareInput()
{
  const ModifiedTimeType modifiedTime = this->GetPixelMTime();
  if (!m_Input || m_InputMTime != modifiedTime)
  {
    m_Input.reset();
    auto input = this->MakeInput(*m_Source);
    this->ReadBeforeRun([&](const auto & observer) { input->Prepare(observer); });
    m_Input = std::move(input);
    m_InputMTime = modifiedTime;
    if (this->GetNeededMaximum())
    {
      this->DropWindow();
    }
  }
  return *m_Input;
}

template <typename TInputImage, typename TOutputImage>
template <typename TFunction>
auto
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::ReadBeforeRun(TFunction && function)
{
  Client                         client(*this, 0, 1);
  PassProgress                   progress(client);
  const MedialVoxelProgressScope scope(progress);
  return function([&progress](double) {
    // Work with a progress of its own hears this one, too.
    const MedialVoxelProgressScope asked(progress);
    MedialVoxelCheckAbort();
  });
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::PrepareScan(const std::optional<MedialVoxelScanLevels> & levels)
{
  const ModifiedTimeType modifiedTime = this->GetPixelMTime();
  if (m_ScanMTime != modifiedTime)
  {
    m_ScanMTime = 0;
    auto & input = static_cast<MedialVoxelObjectInput &>(this->PrepareInput());
    m_Scan = this->ReadBeforeRun([&](const auto & observer) {
      return input.SurveyScan(this->GetGrid(), this->GetLowerThreshold(), this->GetUpperThreshold(), levels, observer);
    });
    // Made again, for walls that are measured like this.
    this->DropWindow();
    m_ScanMTime = modifiedTime;
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::Pull(const MedialVoxelBox & part)
{
  auto * const               input = const_cast<InputImageType *>(this->GetInput());
  const InputImageRegionType region = this->RegionOf(part);
  if (input->GetSource() != nullptr)
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

template <typename TInputImage, typename TOutputImage>
std::exception_ptr
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::MakeAbortException()
{
  ProcessAborted exception(__FILE__, __LINE__);
  exception.SetDescription("Filter execution was aborted by an external request");
  return std::make_exception_ptr(exception);
}

/** A buffer is used again for the next piece; free a small one first, so there are never two. */
template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::ReleaseSmallOutputs()
{
  for (const auto & output : this->GetOutputs())
  {
    const auto * const image = dynamic_cast<const ImageBase<ImageDimension> *>(output.GetPointer());
    if (image != nullptr &&
        image->GetBufferedRegion().GetNumberOfPixels() < image->GetRequestedRegion().GetNumberOfPixels())
    {
      output->ReleaseData();
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::DynamicThreadedGenerateData(const OutputImageRegionType & region)
{
  if (m_Work)
  {
    m_Work();
  }
  else
  {
    MedialVoxelWithItkErrors([&] { return this->RunRegion(this->BoxOf(region)); });
  }
}

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
    spacing[axis] = this->GetUseImageSpacing() ? input->GetSpacing()[axis] : 1.0;
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
template <typename TVectorImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::WriteVectors(TVectorImage &                image,
                                                                    const MedialVoxelTileResult & tile) const
{
  using ValueType = typename TVectorImage::PixelType::ValueType;
  using WriterType = MedialVoxelDisplacementWriter<ImageDimension, ValueType>;
  typename WriterType::MatrixType matrix{};
  for (unsigned int row = 0; row < ImageDimension; ++row)
  {
    for (unsigned int column = 0; column < ImageDimension; ++column)
    {
      const double unit = row == column ? 1.0 : 0.0;
      matrix[row][column] =
        this->GetUseImageSpacing() ? image.GetDirection()[row][column] * image.GetSpacing()[column] : unit;
    }
  }
  ValueType * const first = this->FirstPixelOf(image, tile.box)->GetDataPointer();
  tile.WriteVectors(WriterType(matrix), first, this->StridesOf(image));
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilterBase<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Counts: " << m_Sums.counts << std::endl;
}

} // end namespace itk

#endif
