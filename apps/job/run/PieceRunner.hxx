// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPieceRunner_hxx
#define medialvoxelPieceRunner_hxx

#include "InputVolume.hxx"
#include "LabelValues.h"
#include "PieceRunner.h"

#include "itkMedialVoxelImageFilter.h"
#include "itkVectorDistanceMapImageFilter.h"

#include <type_traits>
#include <utility>

namespace medialvoxel
{

template <typename TImage>
VolumeGeometry
GetImageGeometry(const TImage & image)
{
  VolumeGeometry geometry;
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    geometry.size.push_back(image.GetLargestPossibleRegion().GetSize(axis));
    geometry.spacing.push_back(image.GetSpacing()[axis]);
    geometry.origin.push_back(image.GetOrigin()[axis]);
    std::vector<double> direction;
    for (unsigned int row = 0; row < TImage::ImageDimension; ++row)
    {
      direction.push_back(image.GetDirection()[row][axis]);
    }
    geometry.direction.push_back(direction);
  }
  return geometry;
}

/** \class OtherBuffer
 * \brief The memory of the results of an image that are kept while it gets new ones. */
template <typename TImage>
class OtherBuffer
{
public:
  /** Keeps what the image has, and gives it the memory that was kept before. */
  void
  Exchange(TImage & image)
  {
    const ContainerPointer current = image.GetPixelContainer();
    image.SetPixelContainer(m_Kept ? m_Kept : TImage::PixelContainer::New());
    m_Kept = current;
  }

  void
  Release()
  {
    m_Kept = nullptr;
  }

private:
  using ContainerPointer = typename TImage::PixelContainer::Pointer;

  ContainerPointer m_Kept;
};

/** \class FilterRunner
 * \brief What the runners of both filters share: input, object, threads, pieces, progress. */
template <typename TFilter>
class FilterRunner : public PieceRunner
{
public:
  using InputImageType = typename TFilter::InputImageType;
  using OutputImageType = typename TFilter::OutputImageType;

  FilterRunner(InputVolume & input, const JobOptions & options, const CutSettings & cut, const PieceObserver & observer)
    : m_Observer(observer)
    , m_Input(input)
    , m_Reader(*input.GetReader())
  {
    m_Filter->SetInput(static_cast<ImageInput<InputImageType> &>(input).GetImage());
    m_Filter->SetUseImageSpacing(!options.voxelUnits);
    if (!input.IsMask())
    {
      this->SetObject(options);
    }
    m_Filter->SetSlabThickness(static_cast<unsigned int>(cut.slabThickness));
    m_Filter->SetWorkingMemoryLimit(cut.memoryLimit);
    m_Filter->SetNumberOfWorkUnits(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads());
    m_Filter->AddObserver(itk::ProgressEvent(), [this](const itk::EventObject &) { this->Observe(); });
    m_ReaderTag = m_Reader.AddObserver(itk::ProgressEvent(), [this](const itk::EventObject &) { this->Observe(); });
  }

  ~FilterRunner() override { m_Reader.RemoveObserver(m_ReaderTag); }

  VolumeGeometry
  GetGeometry() const override
  {
    return GetImageGeometry(*m_Filter->GetOutput());
  }

  PieceResults
  Run(std::uint64_t firstSlice, std::uint64_t numberOfSlices) override
  {
    constexpr unsigned int last = InputImageType::ImageDimension - 1;
    OutputImageType &      output = *m_Filter->GetOutput();
    auto                   region = output.GetLargestPossibleRegion();
    region.SetIndex(last, region.GetIndex(last) + static_cast<itk::IndexValueType>(firstSlice));
    region.SetSize(last, numberOfSlices);
    if (m_KeepsPreviousResults)
    {
      this->ExchangeBuffers();
    }
    output.SetRequestedRegion(region);
    output.PropagateRequestedRegion();
    // Not Update(), which would begin the counts anew with each piece.
    output.UpdateOutputData();
    return this->GetResults();
  }

  void
  KeepPreviousResults() override
  {
    m_KeepsPreviousResults = true;
  }

  void
  SetMemoryLimit(std::uint64_t bytes) override
  {
    m_Filter->SetWorkingMemoryLimit(bytes);
  }

  void
  Release() override
  {
    for (auto & output : m_Filter->GetOutputs())
    {
      output->ReleaseData();
    }
    this->ReleaseOtherBuffers();
  }

  RunnerSums
  GetSums() const override
  {
    RunnerSums sums;
    sums.counts.notANumberVoxels = m_Input.GetNumberOfNotANumberVoxels() + m_Filter->GetNumberOfNotANumberVoxels();
    sums.recomputedVoxels = m_Filter->GetNumberOfRecomputedVoxels();
    sums.distanceSeconds = m_Filter->GetDistanceSeconds();
    sums.classificationSeconds = m_Filter->GetClassificationSeconds();
    sums.threadSeconds = m_Filter->GetThreadSeconds();
    sums.tileSeconds = m_Filter->GetTileSeconds();
    return sums;
  }

protected:
  virtual PieceResults
  GetResults() = 0;

  /** Gives the outputs other memory, so that the last results stay. */
  virtual void
  ExchangeBuffers() = 0;

  virtual void
  ReleaseOtherBuffers() = 0;

  typename TFilter::Pointer m_Filter = TFilter::New();

private:
  void
  SetObject(const JobOptions & options)
  {
    if (options.label)
    {
      // CheckLabel() has seen that the type has it.
      m_Filter->SetObjectValue(*ConvertLabel<typename InputImageType::PixelType>(*options.label));
    }
    if (options.lowerThreshold)
    {
      m_Filter->SetLowerThreshold(*options.lowerThreshold);
    }
    if (options.upperThreshold)
    {
      m_Filter->SetUpperThreshold(*options.upperThreshold);
    }
  }

  void
  Observe()
  {
    if (m_Observer(m_Filter->GetProgress()))
    {
      m_Filter->AbortGenerateDataOn();
    }
  }

  PieceObserver        m_Observer;
  InputVolume &        m_Input;
  itk::ProcessObject & m_Reader;
  unsigned long        m_ReaderTag{ 0 };
  bool                 m_KeepsPreviousResults{ false };
};

template <typename TImage>
class ExtractRunner : public FilterRunner<itk::MedialVoxelImageFilter<TImage>>
{
public:
  ExtractRunner(InputVolume &          input,
                const ExtractOptions & options,
                const CutSettings &    cut,
                const PieceObserver &  observer)
    : FilterRunner<itk::MedialVoxelImageFilter<TImage>>(input, options, cut, observer)
  {
    if (options.thickness)
    {
      this->m_Filter->SetThickness(*options.thickness);
    }
    else
    {
      this->m_Filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
      this->m_Filter->SetMinimumThickness(options.minimumThickness.value_or(0.0));
      this->m_Filter->SetMaximumThickness(options.maximumThickness.value_or(0.0));
    }
    if (options.maximumPoreSize)
    {
      this->m_Filter->SetMaximumPoreSize(*options.maximumPoreSize);
    }
    this->m_Filter->SetGenerateVectorDistance(!options.vectorFile.empty());
    this->m_Filter->SetVectorDistanceBoundary(options.vectorBoundary);
    this->m_Filter->SetGenerateThickness(!options.thicknessFile.empty());
    this->m_Filter->SetSubvoxelThickness(options.subVoxel);
    this->m_Filter->UpdateOutputInformation();
  }

  const char *
  GetName() const override
  {
    return "labels";
  }

  void
  SetTileObservers(const std::vector<itk::MedialVoxelTileObserver *> & observers) override
  {
    this->m_Filter->SetTileObservers(observers);
  }

  RunnerSums
  GetSums() const override
  {
    const auto & filter = *this->m_Filter;
    RunnerSums   sums = FilterRunner<itk::MedialVoxelImageFilter<TImage>>::GetSums();
    sums.counts.objectVoxels = filter.GetNumberOfObjectVoxels();
    sums.counts.boundaryVoxels = filter.GetNumberOfBoundaryVoxels();
    sums.counts.filledVoxels = filter.GetNumberOfFilledVoxels();
    sums.counts.removedVoxels = filter.GetNumberOfRemovedVoxels();
    sums.counts.candidateCells = filter.GetNumberOfCandidateCells();
    sums.counts.trivialCells = filter.GetNumberOfTrivialCells();
    sums.counts.boundCells = filter.GetNumberOfBoundCells();
    sums.counts.geodesicMedialCells = filter.GetNumberOfGeodesicMedialCells();
    sums.counts.geodesicNonMedialCells = filter.GetNumberOfGeodesicNonMedialCells();
    return sums;
  }

protected:
  PieceResults
  GetResults() override
  {
    PieceResults results;
    results[VolumeContent::Labels] = this->m_Filter->GetOutput()->GetBufferPointer();
    // No cell and no voxel of an object came in with this piece.
    const std::uint64_t seen = this->m_Filter->GetNumberOfCandidateCells() + this->m_Filter->GetNumberOfObjectVoxels();
    results.isEmpty = seen == std::exchange(m_Seen, seen);
    if (auto * const vectors = this->m_Filter->GetVectorDistanceOutput())
    {
      results[VolumeContent::Vectors] = vectors->GetBufferPointer();
    }
    if (auto * const thicknesses = this->m_Filter->GetThicknessOutput())
    {
      results[VolumeContent::Thicknesses] = thicknesses->GetBufferPointer();
    }
    return results;
  }

  void
  ExchangeBuffers() override
  {
    m_OtherLabels.Exchange(*this->m_Filter->GetOutput());
    if (auto * const vectors = this->m_Filter->GetVectorDistanceOutput())
    {
      m_OtherVectors.Exchange(*vectors);
    }
    if (auto * const thickness = this->m_Filter->GetThicknessOutput())
    {
      m_OtherThickness.Exchange(*thickness);
    }
  }

  void
  ReleaseOtherBuffers() override
  {
    m_OtherLabels.Release();
    m_OtherVectors.Release();
    m_OtherThickness.Release();
  }

private:
  using FilterType = itk::MedialVoxelImageFilter<TImage>;

  std::uint64_t                                     m_Seen{ 0 }; ///< cells and voxels of objects in all pieces so far
  OtherBuffer<typename FilterType::OutputImageType> m_OtherLabels;
  OtherBuffer<typename FilterType::VectorImageType> m_OtherVectors;
  OtherBuffer<typename FilterType::ThicknessImageType> m_OtherThickness;
};

template <typename TImage>
class DistanceRunner : public FilterRunner<itk::VectorDistanceMapImageFilter<TImage>>
{
public:
  DistanceRunner(InputVolume &            input,
                 const JobOptions &       options,
                 const DistanceSettings & settings,
                 const PieceObserver &    observer)
    : FilterRunner<itk::VectorDistanceMapImageFilter<TImage>>(input, options, settings.cut, observer)
  {
    this->m_Filter->SetBoundary(settings.boundary);
    this->m_Filter->SetRegion(settings.region);
    this->m_Filter->SetGenerateDistance(settings.generateDistance);
    if (settings.maximumDistance)
    {
      this->m_Filter->SetMaximumDistance(*settings.maximumDistance);
    }
    this->m_Filter->UpdateOutputInformation();
  }

  const char *
  GetName() const override
  {
    return "distances";
  }

  RunnerSums
  GetSums() const override
  {
    RunnerSums sums = FilterRunner<itk::VectorDistanceMapImageFilter<TImage>>::GetSums();
    sums.counts.objectVoxels = this->m_Filter->GetNumberOfObjectVoxels();
    return sums;
  }

protected:
  PieceResults
  GetResults() override
  {
    PieceResults results;
    results[VolumeContent::Vectors] = this->m_Filter->GetOutput()->GetBufferPointer();
    if (auto * const distances = this->m_Filter->GetDistanceOutput())
    {
      results[VolumeContent::Distances] = distances->GetBufferPointer();
    }
    return results;
  }

  void
  ExchangeBuffers() override
  {
    m_OtherVectors.Exchange(*this->m_Filter->GetOutput());
    if (auto * const distances = this->m_Filter->GetDistanceOutput())
    {
      m_OtherDistances.Exchange(*distances);
    }
  }

  void
  ReleaseOtherBuffers() override
  {
    m_OtherVectors.Release();
    m_OtherDistances.Release();
  }

private:
  using FilterType = itk::VectorDistanceMapImageFilter<TImage>;

  OtherBuffer<typename FilterType::OutputImageType>   m_OtherVectors;
  OtherBuffer<typename FilterType::DistanceImageType> m_OtherDistances;
};

/** Calls function(integral_constant) with the dimension of the volume. */
template <typename TFunction>
std::unique_ptr<PieceRunner>
WithDimension(const VolumeHeader & header, TFunction && function)
{
  return header.geometry.GetDimension() == 2 ? function(std::integral_constant<unsigned int, 2>{})
                                             : function(std::integral_constant<unsigned int, 3>{});
}

template <typename TPixel>
std::unique_ptr<PieceRunner>
MakeExtractRunnerFor(InputVolume &          input,
                     const VolumeHeader &   header,
                     const ExtractOptions & options,
                     const CutSettings &    cut,
                     const PieceObserver &  observer)
{
  return WithDimension(header, [&](auto dimension) -> std::unique_ptr<PieceRunner> {
    using ImageType = itk::Image<TPixel, decltype(dimension)::value>;
    return std::make_unique<ExtractRunner<ImageType>>(input, options, cut, observer);
  });
}

template <typename TPixel>
std::unique_ptr<PieceRunner>
MakeDistanceRunnerFor(InputVolume &            input,
                      const VolumeHeader &     header,
                      const JobOptions &       options,
                      const DistanceSettings & settings,
                      const PieceObserver &    observer)
{
  return WithDimension(header, [&](auto dimension) -> std::unique_ptr<PieceRunner> {
    using ImageType = itk::Image<TPixel, decltype(dimension)::value>;
    return std::make_unique<DistanceRunner<ImageType>>(input, options, settings, observer);
  });
}

} // end namespace medialvoxel

#endif
