// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFilterRun_h
#define medialvoxelFilterRun_h

#include "ArrayRun.h"
#include "LabelValues.h"

#include "itkImage.h"
#include "itkMedialVoxelProgress.h"
#include "itkProcessObject.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{

template <typename TPixel>
using ArrayImage = itk::Image<TPixel, 3>;

/** Has \a image lie in memory that it does not own. */
template <typename TImage>
void
UseMemory(TImage & image, typename TImage::PixelType * memory, const MedialVoxelArray & array)
{
  typename TImage::SizeType size;
  std::copy_n(array.size, 3, size.begin());
  const typename TImage::RegionType region(size);
  auto                              container = TImage::PixelContainer::New();
  container->SetImportPointer(memory, region.GetNumberOfPixels(), false);
  image.SetRegions(region);
  image.SetSpacing(array.spacing);
  image.SetPixelContainer(container);
}

/** The array as an image. Nothing is copied, and filters do not write to it. */
template <typename TPixel>
typename ArrayImage<TPixel>::Pointer
MakeImage(const MedialVoxelArray & array)
{
  auto image = ArrayImage<TPixel>::New();
  UseMemory(*image, const_cast<TPixel *>(static_cast<const TPixel *>(array.values)), array);
  return image;
}

/** Copies the pixels of an output that found its memory too small, or not at all. */
template <typename TImage>
void
KeepPixels(const TImage & image, typename TImage::PixelType * memory)
{
  if (image.GetBufferPointer() != memory)
  {
    std::copy_n(image.GetBufferPointer(), image.GetBufferedRegion().GetNumberOfPixels(), memory);
  }
}

/** Turns vectors from (x, y, z), which ITK has, to (z, y, x). */
inline void
ReverseVectors(float * vectors, const MedialVoxelArray & array)
{
  const std::int64_t number = array.size[0] * array.size[1] * array.size[2];
  for (std::int64_t i = 0; i < number; ++i)
  {
    std::swap(vectors[3 * i], vectors[3 * i + 2]);
  }
}

/** Tells a filter what the object is, and what it may take. */
template <typename TFilter>
void
SetJobOptions(TFilter & filter, const JobOptions & options)
{
  // A label is a range of one value, which every filter has.
  if (const auto lower = options.label ? options.label : options.lowerThreshold)
  {
    filter.SetLowerThreshold(*lower);
  }
  if (const auto upper = options.label ? options.label : options.upperThreshold)
  {
    filter.SetUpperThreshold(*upper);
  }
  filter.SetUseImageSpacing(!options.voxelUnits);
  filter.SetWorkingMemoryLimit(static_cast<itk::SizeValueType>(options.memoryLimit.value_or(0)));
  if (options.threads)
  {
    filter.GetMultiThreader()->SetMaximumNumberOfThreads(*options.threads);
    filter.SetNumberOfWorkUnits(*options.threads);
  }
}

/** Tells a filter which walls are sheets. */
template <typename TFilter>
void
SetWalls(TFilter & filter, const ExtractOptions & options)
{
  using ModeEnum = itk::MedialVoxelEnums::ThicknessMode;
  filter.SetThicknessMode(options.thickness ? ModeEnum::Fixed : ModeEnum::Automatic);
  filter.SetThickness(options.thickness.value_or(filter.GetThickness()));
  filter.SetMinimumThickness(options.minimumThickness.value_or(0.0));
  filter.SetMaximumThickness(options.maximumThickness.value_or(0.0));
  filter.SetSmoothing(GetRequestedSmoothing(options));
  if (options.maximumPoreSize)
  {
    filter.SetMaximumPoreSize(static_cast<itk::SizeValueType>(*options.maximumPoreSize));
  }
}

/** Tells a filter whether walls may be measured on gray values, and on which. */
template <typename TFilter>
void
SetGrayMeasure(TFilter & filter, const ArrayCall & call, const JobOptions & options, const bool mayMeasure)
{
  filter.SetSubvoxelThickness(mayMeasure);
  if (!mayMeasure)
  {
    return;
  }
  // Thresholds that no value reaches do not count.
  const auto range = GetGrayRange(options, call.header);
  if (std::isinf(range.lower))
  {
    filter.SetLowerThreshold(range.lower);
  }
  if (std::isinf(range.upper))
  {
    filter.SetUpperThreshold(range.upper);
  }
}

template <typename TFilter>
void
SetLevels(TFilter & filter, const ExtractOptions & options)
{
  if (options.levels)
  {
    filter.SetScanLevels(options.levels->background, options.levels->material);
  }
}

/** \class ControlProgress
 * \brief Stops what polls outside of the engine, such as the measure of roughness. */
class ControlProgress : public itk::MedialVoxelProgress
{
public:
  explicit ControlProgress(const MedialVoxelControl & control)
    : m_Control(control)
  {}

  bool
  IsAborted() const override
  {
    return m_Control.stop.load(std::memory_order_relaxed) != 0;
  }

  void
  Advance(std::uint64_t) override
  {}

private:
  const MedialVoxelControl & m_Control;
};

/** Runs a filter that tells its progress and can be stopped. */
inline void
RunFilter(itk::ProcessObject & filter, MedialVoxelControl & control)
{
  filter.AddObserver(itk::ProgressEvent(), [&filter, &control](const itk::EventObject &) {
    control.done.store(filter.GetProgress(), std::memory_order_relaxed);
    if (control.stop.load(std::memory_order_relaxed) != 0)
    {
      filter.AbortGenerateDataOn();
    }
  });
  ControlProgress                 progress(control);
  const itk::MedialVoxelPollScope scope(progress);
  filter.Update();
}

} // end namespace medialvoxel

#endif
