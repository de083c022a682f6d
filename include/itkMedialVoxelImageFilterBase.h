// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterBase_h
#define itkMedialVoxelImageFilterBase_h

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelInput.h"
#include "itkMedialVoxelMemoryError.h"
#include "itkMedialVoxelObjectProperties.h"

#include "itkImageToImageFilter.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace itk
{

class MedialVoxelFilterAccess;

/** \class MedialVoxelImageFilterBase
 * \brief Streaming and threads, shared by the filters of the MedialVoxel module.
 *
 * The requested region is processed slab by slab along its slowest axis. For each slab the filter pulls the input that
 * the slab depends on, part by part, and packs it to one bit per voxel. Threads run the tiles of the slab in
 * DynamicThreadedGenerateData(). A tile that depends on more input runs again after the window has grown. Results do
 * not depend on the requested region, on the division of the work, or on the number of threads.
 *
 * The pieces of a streamed update (StreamingImageFilter, ImageFileWriter) share the window: input that two pieces
 * depend on is pulled once when they follow each other along the slowest axis. After an update the input image buffers
 * only the last part that was pulled, unless it has no source or its source cannot stream.
 *
 * \par Memory
 * Beside the outputs of the requested region: one part of the input (a slice, or 1 MiB of slices), two to three bits
 * per voxel of the current window, and a few MiB per thread for thin parts, more where walls are thicker than sixteen
 * voxels. WorkingMemoryLimit caps window and threads.
 *
 * \ingroup MedialVoxel
 */
template <typename TInputImage, typename TOutputImage>
class ITK_TEMPLATE_EXPORT MedialVoxelImageFilterBase
  : public MedialVoxelObjectProperties<ImageToImageFilter<TInputImage, TOutputImage>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialVoxelImageFilterBase);

  using Self = MedialVoxelImageFilterBase;
  using Superclass = MedialVoxelObjectProperties<ImageToImageFilter<TInputImage, TOutputImage>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(MedialVoxelImageFilterBase);
#else
  itkTypeMacro(MedialVoxelImageFilterBase, ImageToImageFilter);
#endif

  static constexpr unsigned int ImageDimension = TInputImage::ImageDimension;
  static_assert(ImageDimension == 2 || ImageDimension == 3, "Images have 2 or 3 dimensions.");
  static_assert(TOutputImage::ImageDimension == ImageDimension, "Input and output have the same dimension.");

  using InputImageType = TInputImage;
  using OutputImageType = TOutputImage;
  using typename Superclass::InputPixelType;
  using InputImageRegionType = typename InputImageType::RegionType;
  using OutputImageRegionType = typename OutputImageType::RegionType;

  /** Numbers of voxels and cells of the requested regions since the last UpdateOutputInformation() that was followed by
   * an execution. The pieces of a streamed update add up to the whole; an aborted execution adds nothing. Members:
   * objectVoxels, boundaryVoxels, notANumberVoxels, filledVoxels, removedVoxels; of filters that label cells also
   * candidateCells, trivialCells, boundCells, geodesicMedialCells, geodesicNonMedialCells. */
  MedialVoxelCounts
  GetCounts() const
  {
    return m_Sums.counts;
  }

  void
  UpdateOutputInformation() override;

protected:
  MedialVoxelImageFilterBase();
  ~MedialVoxelImageFilterBase() override;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyInputInformation() const override;

  void
  GenerateInputRequestedRegion() override;

  void
  GenerateData() override;

  /** Runs the phases. Each thread of GenerateData() calls it and takes part of the work on the requested region. A
   * separate call fills \a region of the allocated outputs and adds nothing to the counts. */
  void
  DynamicThreadedGenerateData(const OutputImageRegionType & region) override;

  /** The engine's task for the derived class. */
  virtual MedialVoxelEngineTask
  GetTask(const MedialVoxelGrid & grid) const = 0;

  /** Write the results of a tile to the outputs. Called by several threads at a time. */
  virtual void
  TakeTile(const MedialVoxelTileResult & tile) = 0;

  /** Process \a region; results up to an exception do not count. Prepares the input and runs the engine once, unless
   * the derived class needs more runs. */
  virtual MedialVoxelSums
  RunRegion(const MedialVoxelBox & region);

  /** Add the counts of the last RunRegion(); \a isNew when sums begin again. Does nothing by default. */
  virtual void
  KeepSums(bool isNew);

  /** Run the engine over \a region. Reports progress as run \a run of \a numberOfRuns over the same region. */
  MedialVoxelSums
  RunEngine(const MedialVoxelBox & region, unsigned int run = 0, unsigned int numberOfRuns = 1);

  /** Forget the window, because the object changes. */
  void
  DropWindow()
  {
    m_Engine.reset();
  }

  /** The input of the engine: by default the object that the properties define, not smoothed. */
  virtual std::unique_ptr<MedialVoxelInput>
  MakeInput(MedialVoxelValueSource & source);

  /** Make the input and run its passes, once for each change of the pixels. */
  MedialVoxelInput &
  PrepareInput();

  /** The input of the last run, if it is one object. */
  const MedialVoxelObjectInput *
  GetObjectInput() const
  {
    return dynamic_cast<const MedialVoxelObjectInput *>(m_Input.get());
  }

  /** The maximum thickness that walls of the input need, where one was looked for and is too small. */
  std::optional<double>
  GetNeededMaximum() const
  {
    const MedialVoxelObjectInput * const input = this->GetObjectInput();
    return input != nullptr ? input->GetNeededMaximum() : std::nullopt;
  }

  /** Find the materials beside the one threshold from samples, once for each change of the input. With two thresholds
   * there is no scan. */
  void
  PrepareScan(const std::optional<MedialVoxelScanLevels> & levels);

  /** The result of PrepareScan(). */
  const MedialVoxelScanResult &
  GetScanResult() const
  {
    return m_Scan;
  }

  /** Gray values to measure walls on; none where walls are measured on the object. */
  std::optional<MedialVoxelSheetExtraction::GrayRange>
  GetGrayRange() const
  {
    if (m_Scan.isMask)
    {
      return std::nullopt;
    }
    return MedialVoxelSheetExtraction::GrayRange{ this->GetLowerThreshold(), this->GetUpperThreshold(), m_Scan.scan };
  }

  /** The exception of an aborted execution. */
  static std::exception_ptr
  MakeAbortException();

  /** Latest change of anything that the window depends on. */
  ModifiedTimeType
  GetWindowMTime() const;

  /** Latest change of the window, and of the pixels of an image without a source, which the pipeline does not
   * report. */
  ModifiedTimeType
  GetPixelMTime() const
  {
    const auto * const     input = this->GetInput();
    const ModifiedTimeType inputMTime = input->GetSource() == nullptr ? input->GetMTime() : 0;
    return std::max(this->GetWindowMTime(), inputMTime);
  }

  /** Sums over the requested regions since the last UpdateOutputInformation() that was followed by an execution. */
  const MedialVoxelSums &
  GetSums() const
  {
    return m_Sums;
  }

  /** Size and spacing of the whole input image, in the units of the parameters. */
  MedialVoxelGrid
  GetGrid() const;

  /** Region of the input's index space as a box of the grid, and back. */
  MedialVoxelBox
  BoxOf(const ImageRegion<ImageDimension> & region) const;

  ImageRegion<ImageDimension>
  RegionOf(const MedialVoxelBox & box) const;

  /** The pixel of \a image that \a box begins at. */
  template <typename TImage>
  auto *
  FirstPixelOf(TImage & image, const MedialVoxelBox & box) const
  {
    return image.GetBufferPointer() + image.ComputeOffset(this->RegionOf(box).GetIndex());
  }

  /** Pixels of \a image from one voxel to the next along each axis. */
  template <typename TImage>
  static MedialVoxelStrides
  StridesOf(const TImage & image)
  {
    MedialVoxelStrides strides{};
    std::copy_n(image.GetOffsetTable(), ImageDimension, strides.begin());
    return strides;
  }

  /** Write the displacements of \a tile as vectors, in physical units or in voxels as UseImageSpacing says. */
  template <typename TVectorImage>
  void
  WriteVectors(TVectorImage & image, const MedialVoxelTileResult & tile) const;

private:
  friend class MedialVoxelFilterAccess;

  class Source;
  class Client;
  class PassProgress;

  /** Call function(observer), which reads the input before the engine does and can be aborted. */
  template <typename TFunction>
  auto
  ReadBeforeRun(TFunction && function);

  void
  ReleaseSmallOutputs();

  MedialVoxelEngineSettings
  GetEngineSettings(const MedialVoxelGrid & grid) const;

  /** Threads that process tiles at the same time, when there are enough tiles. */
  unsigned int
  GetNumberOfWorkers() const;

  /** The engine for the next execution: the last one when it continues the same streamed update. */
  void
  PrepareEngine(const MedialVoxelGrid & grid);

  /** Have the pipeline produce a part of the input. */
  void
  Pull(const MedialVoxelBox & part);

  /** Edge of the tiles in voxels, and voxels along the slowest axis between two pulls of input; 0 chooses. */
  unsigned int m_TileSize{ 0 };
  unsigned int m_SlabThickness{ 0 };

  MedialVoxelSums m_Sums;
  bool            m_StartNewSum{ true };

  /** Keeps its window from piece to piece of a streamed update, so that shared input is pulled once. */
  std::unique_ptr<MedialVoxelEngine> m_Engine;
  ModifiedTimeType                   m_EngineMTime{ 0 };

  std::unique_ptr<Source>           m_Source;
  std::unique_ptr<MedialVoxelInput> m_Input;
  ModifiedTimeType                  m_InputMTime{ 0 };

  MedialVoxelScanResult m_Scan;
  ModifiedTimeType      m_ScanMTime{ 0 };

  /** Of a thread, as long as the engine runs. */
  std::function<void()> m_Work;
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMedialVoxelImageFilterBase.hxx"
#endif

#endif
