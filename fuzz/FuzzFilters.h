// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzFilters_h
#define FuzzFilters_h

#include "FuzzOracle.h"
#include "FuzzScene.h"
#include "FuzzSupport.h"

#include "MedialVoxelTestSupport.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkImageRegionSplitterMultidimensional.h"
#include "itkMedialVoxelImageFilterBase.h"
#include "itkStreamingImageFilter.h"

#include <cstring>
#include <type_traits>

namespace MedialVoxelFuzz
{

/** How the work is cut, which must not change a byte. */
struct Cut
{
  unsigned int       tileSize{ 0 };
  unsigned int       slabThickness{ 0 };
  unsigned int       workUnits{ 1 };
  itk::SizeValueType memoryLimit{ 0 };
  bool               hasSource{ false }; ///< that gives no more of the input than is asked for
};

/** Mostly one thread: starting more takes longer than the work on a small image. */
inline Cut
ChooseCut(Choices & choices)
{
  Cut cut;
  cut.tileSize = static_cast<unsigned int>(choices.Next(0, 70));
  cut.slabThickness = static_cast<unsigned int>(choices.Next(0, 20));
  cut.workUnits = choices.Rarely(8) ? 3 : 1;
  cut.memoryLimit = choices.Next(0, 7) == 0 ? (1U << 18) * choices.Byte() : 0;
  cut.hasSource = choices.Flag();
  return cut;
}

/** \class SceneInput
 * \brief The image of a scene, as it lies or from a source. */
template <typename TImage>
class SceneInput
{
public:
  explicit SceneInput(const Scene & scene)
    : m_Image(MedialVoxelTest::MakeImage<TImage>(scene.volume, scene.start))
  {
    using PixelType = typename TImage::PixelType;
    std::transform(scene.values.begin(), scene.values.end(), m_Image->GetBufferPointer(), [](float value) {
      return static_cast<PixelType>(value);
    });
    typename TImage::DirectionType direction;
    direction.Fill(0.0);
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      direction(scene.axisOf[axis], axis) = scene.signOf[axis];
    }
    m_Image->SetDirection(direction);
    m_Source->SetImage(m_Image);
  }

  const TImage *
  GetImage(bool hasSource) const
  {
    return hasSource ? m_Source->GetOutput() : m_Image.GetPointer();
  }

private:
  using SourceType = MedialVoxelTest::RecordingSource<TImage>;

  typename TImage::Pointer     m_Image;
  typename SourceType::Pointer m_Source = SourceType::New();
};

/** Has a filter take the image of a scene for what it is. */
template <typename TFilter>
void
SetScene(TFilter &                                            filter,
         const Scene &                                        scene,
         const SceneInput<typename TFilter::InputImageType> & input,
         const Cut &                                          cut)
{
  // Most warnings are of a spacing that is unequal.
  itk::Object::GlobalWarningDisplayOff();
  filter.SetInput(input.GetImage(cut.hasSource));
  filter.SetUseImageSpacing(scene.useImageSpacing);
  filter.SetBackgroundValue(static_cast<typename TFilter::InputPixelType>(scene.backgroundValue));
  if (scene.lowerThreshold)
  {
    filter.SetLowerThreshold(*scene.lowerThreshold);
  }
  if (scene.upperThreshold)
  {
    filter.SetUpperThreshold(*scene.upperThreshold);
  }
  filter.SetNumberOfWorkUnits(cut.workUnits);
  filter.SetWorkingMemoryLimit(cut.memoryLimit);
}

template <typename TFilter>
void
SetTiles(TFilter & filter, const Cut & cut)
{
  itk::MedialVoxelFilterAccess::SetTileSize(filter, cut.tileSize);
  itk::MedialVoxelFilterAccess::SetSlabThickness(filter, cut.slabThickness);
}

/** All of a question but the bound, which the mesh has not. Brute force takes the object as it is. */
template <typename TFilter>
void
SetWalls(TFilter & filter, const Question & question)
{
  filter.SetThicknessMode(question.thickness ? itk::MedialVoxelThicknessMode::Fixed
                                             : itk::MedialVoxelThicknessMode::Automatic);
  filter.SetThickness(question.thickness.value_or(3.0));
  filter.SetMinimumThickness(question.minimumThickness);
  filter.SetMaximumThickness(question.maximumThickness);
  filter.SetSmoothing(itk::MedialVoxelSmoothing::Off);
  filter.UnsetMaximumPoreSize();
  if (question.maximumPoreSize)
  {
    filter.SetMaximumPoreSize(static_cast<itk::SizeValueType>(*question.maximumPoreSize));
  }
}

template <typename TRegion>
TRegion
ChooseRegion(Choices & choices, const TRegion & whole)
{
  TRegion region;
  for (unsigned int axis = 0; axis < TRegion::ImageDimension; ++axis)
  {
    const int size = static_cast<int>(whole.GetSize(axis));
    const int first = choices.Next(0, size - 1);
    region.SetIndex(axis, whole.GetIndex(axis) + first);
    region.SetSize(axis, static_cast<itk::SizeValueType>(choices.Next(1, size - first)));
  }
  return region;
}

/** The bytes of two images in a region, NaN too. */
template <typename TImage>
void
RequireSame(const TImage &                      image,
            const TImage &                      expected,
            const typename TImage::RegionType & region,
            const char *                        what)
{
  using PixelType = typename TImage::PixelType;
  itk::ImageRegionConstIterator<TImage> other(&expected, region);
  for (itk::ImageRegionConstIterator<TImage> it(&image, region); !it.IsAtEnd(); ++it, ++other)
  {
    const PixelType a = it.Get();
    const PixelType b = other.Get();
    Require(std::memcmp(&a, &b, sizeof a) == 0, what);
  }
}

/** Calls \a run, which may need more memory than the limit of a cut, but must say so. */
template <typename TRun>
void
RunWithin(const Cut & cut, TRun && run)
try
{
  run();
}
catch (const itk::MedialVoxelMemoryError & error)
{
  Require(cut.memoryLimit > 0 && error.GetNeededBytes() > cut.memoryLimit, error.what());
}

/** Names a type of image to a function that can take any. */
template <typename TImage>
struct Kind
{
  using ImageType = TImage;
  static constexpr Values values =
    std::is_floating_point<typename TImage::PixelType>::value ? Values::Real : Values::Whole;
};

/** Calls \a check(choices, kind) for an input of a fuzzer, with the kind of image that it chooses. */
template <typename TCheck>
int
CheckInput(const std::uint8_t * data, std::size_t size, TCheck && check)
{
  if (size > MostBytesOfScene)
  {
    return 0;
  }
  Choices choices(data, size);
  switch (choices.Next(0, 3))
  {
    case 0:
      check(choices, Kind<itk::Image<unsigned char, 2>>());
      break;
    case 1:
      check(choices, Kind<itk::Image<unsigned char, 3>>());
      break;
    default:
      check(choices, Kind<itk::Image<float, 3>>());
  }
  return 0;
}

/** The output of a filter piece by piece. */
template <typename TFilter>
typename TFilter::OutputImageType::Pointer
Stream(TFilter & filter, unsigned int divisions)
{
  using ImageType = typename TFilter::OutputImageType;
  auto streamer = itk::StreamingImageFilter<ImageType, ImageType>::New();
  streamer->SetInput(filter.GetOutput());
  streamer->SetRegionSplitter(itk::ImageRegionSplitterMultidimensional::New());
  streamer->SetNumberOfStreamDivisions(divisions);
  streamer->Update();
  return streamer->GetOutput();
}

/** Vectors where brute force has them, NaN where it has none. */
template <typename TImage>
void
RequireVectors(const TImage & image, const std::vector<std::array<float, 3>> & expected)
{
  const auto * const vectors = image.GetBufferPointer();
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      const bool bothNan = std::isnan(vectors[i][axis]) && std::isnan(expected[i][axis]);
      Require(bothNan || vectors[i][axis] == expected[i][axis], "a vector differs from that by brute force");
    }
  }
}

} // namespace MedialVoxelFuzz

#endif
