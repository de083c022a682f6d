// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilterBase_h
#define itkMedialVoxelImageFilterBase_h

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelLimit.h"
#include "itkMedialVoxelMemoryError.h"
#include "itkMedialVoxelObjectMap.h"
#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelRoughness.h"
#include "itkMedialVoxelScanSurvey.h"

#include "itkImageToImageFilter.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace itk
{

/** \class MedialVoxelImageFilterBase
 * \brief Object definition, streaming and threads that the filters of the MedialVoxel module share.
 *
 * The requested region is processed slab by slab along its slowest axis. For each slab the filter pulls the input that
 * the slab depends on, part by part, and packs it to one bit per voxel. Threads run the
 * tiles of the slab in DynamicThreadedGenerateData(). A tile that depends on more input runs again after the window has
 * grown. Results do not depend on the requested region, on the division of the work, or on the number of threads.
 *
 * The pieces of a streamed update (StreamingImageFilter, ImageFileWriter) share the window: input that two pieces
 * depend on is pulled once when they follow each other along the slowest axis. After an update the input image buffers
 * only the last part that was pulled, unless it has no source or its source cannot stream.
 *
 * \par Object
 * Until a threshold is set, voxels that differ from BackgroundValue are object. Setting LowerThreshold or
 * UpperThreshold switches to LowerThreshold <= value <= UpperThreshold. Thresholds are compared as real numbers: 72.5
 * on an integer image means at least 73. A threshold given as an integer is exact for all 64 bits; the getters return
 * the nearest double. NaN is never object. The outside of the image is unknown: the end of the image is no boundary.
 *
 * \par Memory
 * Beside the outputs of the requested region: one part of the input (a slice, or 1 MiB of slices), two to three bits
 * per voxel of the current window, and a few MiB per thread for thin parts, more where walls are thicker than sixteen
 * voxels. WorkingMemoryLimit caps window and threads.
 *
 * \ingroup MedialVoxel
 */
template <typename TInputImage, typename TOutputImage>
class ITK_TEMPLATE_EXPORT MedialVoxelImageFilterBase : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialVoxelImageFilterBase);

  using Self = MedialVoxelImageFilterBase;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
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
  using InputPixelType = typename InputImageType::PixelType;
  using InputImageRegionType = typename InputImageType::RegionType;
  using OutputImageRegionType = typename OutputImageType::RegionType;

  /** Value of the background as long as no threshold is set. Default 0. */
  itkSetMacro(BackgroundValue, InputPixelType);
  itkGetConstMacro(BackgroundValue, InputPixelType);

  /** Smallest value of an object voxel. Default minus infinity; not NaN, not above UpperThreshold. */
  virtual void
  SetLowerThreshold(double threshold);
#ifndef ITK_WRAPPING_PARSER
  virtual void
  SetLowerThreshold(const MedialVoxelLimit & threshold);
  template <typename TInteger, std::enable_if_t<std::is_integral<TInteger>::value, int> = 0>
  void
  SetLowerThreshold(const TInteger threshold)
  {
    this->SetLowerThreshold(MedialVoxelLimit(threshold));
  }
#endif
  double
  GetLowerThreshold() const
  {
    return m_LowerThreshold.GetNearestDouble();
  }

  /** Largest value of an object voxel. Default infinity; not NaN, not below LowerThreshold. */
  virtual void
  SetUpperThreshold(double threshold);
#ifndef ITK_WRAPPING_PARSER
  virtual void
  SetUpperThreshold(const MedialVoxelLimit & threshold);
  template <typename TInteger, std::enable_if_t<std::is_integral<TInteger>::value, int> = 0>
  void
  SetUpperThreshold(const TInteger threshold)
  {
    this->SetUpperThreshold(MedialVoxelLimit(threshold));
  }
#endif
  double
  GetUpperThreshold() const
  {
    return m_UpperThreshold.GetNearestDouble();
  }

  /** The object consists of the voxels with exactly this value, up to 64 bits, as in a label map. Setting it replaces
   * thresholds; setting a threshold replaces it. */
  virtual void
  SetObjectValue(InputPixelType value);
  itkGetConstMacro(ObjectValue, InputPixelType);

  /** True when ObjectValue defines the object. Default false. */
  itkGetConstMacro(UseObjectValue, bool);

  /** Return to BackgroundValue after a threshold or ObjectValue was set. */
  virtual void
  UnsetThresholds();

  /** True once a threshold was set. */
  itkGetConstMacro(UseThresholds, bool);

  /** Measure in physical units (default, as in SignedMaurerDistanceMapImageFilter) or in voxels. */
  itkSetMacro(UseImageSpacing, bool);
  itkGetConstMacro(UseImageSpacing, bool);
  itkBooleanMacro(UseImageSpacing);

#ifndef ITK_WRAPPING_PARSER // tests cut the work with these; other languages need neither
  /** Edge in voxels of the tiles that threads work on; 0 (default) chooses. Has no influence on results. */
  itkSetMacro(TileSize, unsigned int);
  itkGetConstMacro(TileSize, unsigned int);

  /** Voxels along the slowest axis that are processed between two pulls of input; 0 (default) chooses. Has no influence
   * on results; smaller slabs need less memory and give threads less to share. */
  itkSetMacro(SlabThickness, unsigned int);
  itkGetConstMacro(SlabThickness, unsigned int);
#endif

  /** Limit in bytes on the window on the input and the memory of all threads, beside the outputs and the part of input
   * that is pulled; 0 (default) is without limit. Slabs and tiles become smaller to keep it; results stay the same. If
   * walls are too thick for it, the update throws MedialVoxelMemoryError. */
  itkSetMacro(WorkingMemoryLimit, SizeValueType);
  itkGetConstMacro(WorkingMemoryLimit, SizeValueType);

  /** Number of voxels of the requested regions that are NaN, which counts as background.
   *
   * A sum starts at the first execution after an UpdateOutputInformation(); the pieces of a streamed update add up. */
  SizeValueType
  GetNumberOfNotANumberVoxels() const
  {
    return static_cast<SizeValueType>(m_Sums.counts.notANumberVoxels);
  }

  /** Number of voxels of tiles that ran again because the window was too small at first; summed like the counts. Thin
   * parts have none. */
  SizeValueType
  GetNumberOfRecomputedVoxels() const
  {
    return static_cast<SizeValueType>(m_Sums.recomputedVoxels);
  }

  /** Seconds that all threads together spent in the distance transform; summed like the counts. */
  double
  GetDistanceSeconds() const
  {
    return m_Sums.distanceSeconds;
  }

  /** Seconds that all threads together spent in the classification; summed like the counts. */
  double
  GetClassificationSeconds() const
  {
    return m_Sums.classificationSeconds;
  }

  /** Seconds that all threads together spent on tiles, on writing them to the outputs, and on what tiles need to know
   * of the input; summed like the counts. */
  double
  GetThreadSeconds() const
  {
    return m_Sums.threadSeconds;
  }

  /** Seconds from the first to the last work of the threads; summed like the counts. The number of threads times this
   * is the upper bound of ThreadSeconds. */
  double
  GetTileSeconds() const
  {
    return m_Sums.tileSeconds;
  }

  void
  UpdateOutputInformation() override;

protected:
  MedialVoxelImageFilterBase();
  ~MedialVoxelImageFilterBase() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  VerifyInputInformation() ITKv5_CONST override;

  void
  GenerateInputRequestedRegion() override;

  void
  GenerateData() override;

  /** Runs the phases. Each thread of GenerateData() calls it, and takes part of the work on the requested region.
   * Called by itself, it fills \a region of the outputs, which are allocated, and adds nothing to the counts. */
  void
  DynamicThreadedGenerateData(const OutputImageRegionType & region) override;

  /** What the engine is to do for the derived class. */
  virtual MedialVoxelEngineTask
  GetTask(const MedialVoxelGrid & grid) const = 0;

  /** Write what was found in a tile to the outputs. Called by several threads at a time. */
  virtual void
  TakeTile(const MedialVoxelTileResult & tile) = 0;

  /** Process \a region; what was found up to an exception does not count. Runs the engine once, unless the derived
   * class needs more. */
  virtual MedialVoxelSums
  RunRegion(const MedialVoxelBox & region);

  /** Count what the last RunRegion() found; \a isNew when sums begin again. Does nothing by default. */
  virtual void
  KeepSums(bool isNew);

  /** Run the engine over \a region. Tells the progress of the run \a run of \a numberOfRuns over the same region. */
  MedialVoxelSums
  RunEngine(const MedialVoxelBox & region, unsigned int run = 0, unsigned int numberOfRuns = 1);

  /** Forget the window, because the object changes. */
  void
  DropWindow()
  {
    m_Engine.reset();
  }

  /** True when the object is that of smoothed values; false by default. */
  virtual bool
  SmoothsObject() const;

  /** Read all of the input once. SmoothsObject() is false meanwhile. */
  MedialVoxelRoughness
  MeasureRoughness();

  /** Read samples of the input: its values beside its one threshold. There is no scan with two of them. */
  MedialVoxelScanSurvey::Result
  SurveyScan(const std::optional<MedialVoxelScanLevels> & levels);

  /** The objects of the input, of which those that it shows are object; null, the default: values define one object. */
  virtual const MedialVoxelObjectMap *
  GetObjectMap() const;

  /** Have the pipeline produce \a box part by part, in the order of the voxels, and call function(part, first pixel).
   */
  template <typename TFunction>
  void
  ForEachPart(const MedialVoxelBox & box, TFunction && function);

  /** What ends an execution that is aborted. */
  static std::exception_ptr
  MakeAbortException();

  /** Latest change of anything that the window depends on. */
  ModifiedTimeType
  GetWindowMTime() const;

  /** Latest change of the window, and of the pixels of an image without a source, which the pipeline does not tell. */
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
  class Client;
  class PassProgress;

  void
  ReleaseSmallOutputs();

  MedialVoxelEngineSettings
  GetEngineSettings(const MedialVoxelGrid & grid) const;

  /** Threads that process tiles at the same time, when there are enough tiles. */
  unsigned int
  GetNumberOfWorkers() const;

  /** The engine for the next execution: that of the last one when it continues the same streamed update. */
  void
  PrepareEngine(const MedialVoxelGrid & grid);

  /** Have the pipeline produce a part of the input. */
  void
  Pull(const MedialVoxelBox & part);

  void
  SetThreshold(MedialVoxelLimit & target, const MedialVoxelLimit & threshold)
  {
    m_UseObjectValue = false;
    if (!m_UseThresholds || target != threshold)
    {
      m_UseThresholds = true;
      target = threshold;
      this->Modified();
    }
  }

  using PredicateType = MedialVoxelObjectPredicate<InputPixelType>;

  PredicateType
  GetPredicate() const;

  InputPixelType   m_BackgroundValue{};
  MedialVoxelLimit m_LowerThreshold{ -std::numeric_limits<double>::infinity() };
  MedialVoxelLimit m_UpperThreshold{ std::numeric_limits<double>::infinity() };
  bool             m_UseThresholds{ false };
  InputPixelType   m_ObjectValue{};
  bool             m_UseObjectValue{ false };
  bool             m_UseImageSpacing{ true };
  unsigned int     m_TileSize{ 0 };
  unsigned int     m_SlabThickness{ 0 };
  SizeValueType    m_WorkingMemoryLimit{ 0 };

  MedialVoxelSums m_Sums;
  bool            m_StartNewSum{ true };

  /** Keeps its window from piece to piece of a streamed update, so that shared input is pulled once. */
  std::unique_ptr<MedialVoxelEngine> m_Engine;
  ModifiedTimeType                   m_EngineMTime{ 0 };

  /** Of a thread, as long as the engine runs. */
  std::function<void()> m_Work;
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMedialVoxelImageFilterBase.hxx"
#endif

#endif
