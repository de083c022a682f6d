// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Smoothing of the filters: what they compute is what they compute of a mask that was smoothed by the definition.

#include "itkMedialSurfaceMeshFilter.h"
#include "itkMedialVoxelObjectsImageFilter.h"

#include "MedialVoxelTestMesh.h"
#include "MedialVoxelTestSupport.h"

#include "itkImageDuplicator.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkStreamingImageFilter.h"

#include <cmath>
#include <random>

namespace
{
using namespace MedialVoxelTest;
using Smoothing = itk::MedialVoxelSmoothing;
using Mode = itk::MedialVoxelThicknessMode;

template <typename TPixel, unsigned int D>
using Input = itk::Image<TPixel, D>;

/** A tilted wall of 3 voxels with values from 100 to 200, and noise. */
template <typename TImage>
typename TImage::Pointer
MakeWall(double noise)
{
  auto                       image = TImage::New();
  typename TImage::SizeType  size;
  typename TImage::IndexType start;
  std::mt19937               random(11);
  std::normal_distribution<> deviation(0, noise);
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    size[axis] = 34 + 3 * axis;
    start[axis] = 5 - 4 * static_cast<int>(axis);
  }
  image->SetRegions({ start, size });
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<TImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    double distance = -3;
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      const double at = static_cast<double>(it.GetIndex()[axis] - start[axis]) - static_cast<double>(size[axis]) / 2;
      distance += at * (axis + 1) / std::sqrt(TImage::ImageDimension == 2 ? 5 : 14);
    }
    const double inside = std::max(0.0, std::min(1.0, 2 - std::abs(distance)));
    it.Set(static_cast<typename TImage::PixelType>(std::lround(100 + 100 * inside + deviation(random))));
  }
  return image;
}

/** [1 2 1] / 4 along each axis; beyond a face its pixel repeats. */
template <typename TReal>
typename TReal::Pointer
Step(const TReal * image)
{
  typename TReal::Pointer result;
  for (unsigned int axis = 0; axis < TReal::ImageDimension; ++axis)
  {
    auto duplicator = itk::ImageDuplicator<TReal>::New();
    duplicator->SetInputImage(axis == 0 ? image : result.GetPointer());
    duplicator->Update();
    const typename TReal::ConstPointer before = axis == 0 ? image : result.GetPointer();
    result = duplicator->GetOutput();
    const auto region = image->GetBufferedRegion();
    for (itk::ImageRegionIteratorWithIndex<TReal> it(result, region); !it.IsAtEnd(); ++it)
    {
      auto left = it.GetIndex();
      auto right = it.GetIndex();
      left[axis] = std::max(left[axis] - 1, region.GetIndex(axis));
      right[axis] = std::min(right[axis] + 1, region.GetUpperIndex()[axis]);
      it.Set((before->GetPixel(left) + before->GetPixel(right) + 2 * before->GetPixel(it.GetIndex())) / 4);
    }
  }
  return result;
}

/** The middle between the values of a threshold, of which the object has one. */
template <typename TImage>
double
FindLevel(const TImage * image, const double threshold, const bool objectIsAbove)
{
  double below = -std::numeric_limits<double>::infinity();
  double above = std::numeric_limits<double>::infinity();
  for (itk::ImageRegionConstIteratorWithIndex<TImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto value = static_cast<double>(it.Get());
    const bool isAbove = objectIsAbove ? value >= threshold : value > threshold;
    (isAbove ? above : below) = isAbove ? std::min(above, value) : std::max(below, value);
  }
  return (below + above) / 2;
}

/** The mask of what is object of F of value(pixel). */
template <typename TImage, typename TValue, typename TIsObject>
auto
MakeSmoothedMask(const TImage * image, TValue && value, TIsObject && isObject)
{
  using RealImage = itk::Image<double, TImage::ImageDimension>;
  using MaskImage = itk::Image<unsigned char, TImage::ImageDimension>;
  auto real = RealImage::New();
  real->CopyInformation(image);
  real->SetRegions(image->GetBufferedRegion());
  real->Allocate();
  auto mask = MaskImage::New();
  mask->CopyInformation(image);
  mask->SetRegions(image->GetBufferedRegion());
  mask->Allocate();
  const auto region = image->GetBufferedRegion();
  for (itk::ImageRegionIteratorWithIndex<RealImage> it(real, region); !it.IsAtEnd(); ++it)
  {
    it.Set(value(image->GetPixel(it.GetIndex())));
  }
  const auto two = Step(Step(real.GetPointer()).GetPointer());
  const auto four = Step(Step(two.GetPointer()).GetPointer());
  for (itk::ImageRegionIteratorWithIndex<MaskImage> it(mask, region); !it.IsAtEnd(); ++it)
  {
    it.Set(isObject(3 * two->GetPixel(it.GetIndex()) - 2 * four->GetPixel(it.GetIndex())) ? 1 : 0);
  }
  return mask;
}

template <typename TImage>
typename itk::MedialVoxelImageFilter<TImage>::Pointer
MakeFilter(TImage * image, Smoothing smoothing)
{
  auto filter = itk::MedialVoxelImageFilter<TImage>::New();
  filter->SetInput(image);
  filter->SetThicknessMode(Mode::Automatic);
  filter->SetSmoothing(smoothing);
  return filter;
}

template <typename TFilter, typename TMask>
void
ExpectThatOf(TFilter & filter, TMask mask)
{
  const auto plain = MakeFilter(mask.GetPointer(), Smoothing::Off);
  plain->Update();
  filter.Update();
  EXPECT_TRUE(AreEqual(PixelsOf(filter.GetOutput()), PixelsOf(plain->GetOutput())));
  EXPECT_EQ(filter.GetCounts().objectVoxels, plain->GetCounts().objectVoxels);
  EXPECT_GT(filter.GetCounts().objectVoxels, 0u);
  EXPECT_TRUE(filter.GetObjectIsSmoothed());
  EXPECT_FALSE(plain->GetObjectIsSmoothed());
}

template <typename TPixel, unsigned int D>
void
TestRules()
{
  using ImageType = Input<TPixel, D>;
  const auto image = MakeWall<ImageType>(25);
  const auto value = [](TPixel pixel) { return static_cast<double>(pixel); };
  const auto lower = MakeFilter(image.GetPointer(), Smoothing::On);
  lower->SetLowerThreshold(150);
  const double lowerLevel = FindLevel(image.GetPointer(), 150, true);
  ExpectThatOf(*lower, MakeSmoothedMask(image.GetPointer(), value, [&](double f) { return f >= lowerLevel; }));
  const auto upper = MakeFilter(image.GetPointer(), Smoothing::On);
  upper->SetUpperThreshold(130);
  const double upperLevel = FindLevel(image.GetPointer(), 130, false);
  ExpectThatOf(*upper, MakeSmoothedMask(image.GetPointer(), value, [&](double f) { return f <= upperLevel; }));
  const auto range = MakeFilter(image.GetPointer(), Smoothing::On);
  range->SetLowerThreshold(150);
  range->SetUpperThreshold(240);
  const auto isIn = [](TPixel pixel) { return pixel >= 150 && pixel <= 240 ? 1.0 : 0.0; };
  ExpectThatOf(*range, MakeSmoothedMask(image.GetPointer(), isIn, [](double f) { return f >= 0.5; }));
  const auto object = MakeFilter(image.GetPointer(), Smoothing::On);
  object->SetBackgroundValue(static_cast<TPixel>(100));
  const auto isOther = [](TPixel pixel) { return pixel != static_cast<TPixel>(100) ? 1.0 : 0.0; };
  ExpectThatOf(*object, MakeSmoothedMask(image.GetPointer(), isOther, [](double f) { return f >= 0.5; }));
}

} // namespace

TEST(MedialVoxelSmoothedFilter, IsThatOfASmoothedMask)
{
  TestRules<unsigned char, 3>();
  TestRules<short, 3>();
  TestRules<float, 3>();
  TestRules<unsigned short, 2>();
}

TEST(MedialVoxelSmoothedFilter, AnyDivisionAndThreads)
{
  using ImageType = Input<short, 3>;
  const auto image = MakeWall<ImageType>(25);
  const auto whole = MakeFilter(image.GetPointer(), Smoothing::On);
  whole->SetLowerThreshold(150);
  whole->Update();
  const auto expected = PixelsOf(whole->GetOutput());
  for (const unsigned int divisions : { 1u, 3u, 17u })
  {
    for (const unsigned int threads : { 1u, 4u })
    {
      for (const bool isPipeline : { false, true })
      {
        auto source = itk::StreamingImageFilter<ImageType, ImageType>::New();
        source->SetInput(image);
        const auto filter = MakeFilter(image.GetPointer(), Smoothing::Automatic);
        if (isPipeline)
        {
          filter->SetInput(source->GetOutput());
        }
        filter->SetLowerThreshold(150);
        filter->SetNumberOfWorkUnits(threads);
        using LabelImage = itk::Image<unsigned char, 3>;
        auto streaming = itk::StreamingImageFilter<LabelImage, LabelImage>::New();
        streaming->SetInput(filter->GetOutput());
        streaming->SetNumberOfStreamDivisions(divisions);
        streaming->Update();
        EXPECT_TRUE(AreEqual(PixelsOf(streaming->GetOutput()), expected));
        EXPECT_GT(filter->GetRoughness(), 0.02);
      }
    }
  }
}

TEST(MedialVoxelSmoothedFilter, TheRoughnessDecides)
{
  using ImageType = Input<short, 3>;
  for (const bool isNoisy : { true, false })
  {
    const auto image = MakeWall<ImageType>(isNoisy ? 25 : 0);
    const auto filter = MakeFilter(image.GetPointer(), Smoothing::Automatic);
    filter->SetLowerThreshold(150);
    filter->Update();
    EXPECT_EQ(filter->GetObjectIsSmoothed(), isNoisy);
    const auto same = MakeFilter(image.GetPointer(), isNoisy ? Smoothing::On : Smoothing::Off);
    same->SetLowerThreshold(150);
    same->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), PixelsOf(same->GetOutput())));
    EXPECT_EQ(same->GetRoughness(), 0.0);
  }
}

TEST(MedialVoxelSmoothedFilter, IsDecidedAnewWhenTheInputChanges)
{
  using ImageType = Input<short, 3>;
  const auto noisy = MakeWall<ImageType>(25);
  const auto clean = MakeWall<ImageType>(0);
  const auto filter = MakeFilter(noisy.GetPointer(), Smoothing::Automatic);
  filter->SetLowerThreshold(150);
  filter->Update();
  EXPECT_TRUE(filter->GetObjectIsSmoothed());
  filter->SetInput(clean);
  filter->Update();
  EXPECT_FALSE(filter->GetObjectIsSmoothed());
  std::copy_n(noisy->GetBufferPointer(), noisy->GetBufferedRegion().GetNumberOfPixels(), clean->GetBufferPointer());
  clean->Modified();
  filter->Update();
  EXPECT_TRUE(filter->GetObjectIsSmoothed());
}

TEST(MedialVoxelSmoothedFilter, Defaults)
{
  const auto filter = itk::MedialVoxelImageFilter<Input<short, 3>>::New();
  EXPECT_EQ(filter->GetSmoothing(), Smoothing::Off);
  filter->SetThicknessMode(Mode::Automatic);
  EXPECT_EQ(filter->GetSmoothing(), Smoothing::Automatic);
  filter->SetSmoothing(Smoothing::On);
  EXPECT_EQ(filter->GetSmoothing(), Smoothing::On);
  filter->UnsetSmoothing();
  EXPECT_EQ(filter->GetSmoothing(), Smoothing::Automatic);
}

TEST(MedialVoxelSmoothedFilter, ObjectsOfALabelMapAreNotSmoothed)
{
  const auto image = MakeWall<Input<short, 3>>(25);
  const auto filter = itk::MedialVoxelObjectsImageFilter<Input<short, 3>>::New();
  filter->SetInput(image);
  filter->SetThicknessMode(Mode::Automatic);
  EXPECT_EQ(filter->GetSmoothing(), Smoothing::Off);
  filter->SetSmoothing(Smoothing::On);
  try
  {
    filter->Update();
    FAIL() << "no exception";
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find("Smoothing must be Off"), std::string::npos);
  }
}

TEST(MedialVoxelSmoothedFilter, Surface)
{
  using ImageType = Input<short, 3>;
  using SurfaceFilter = itk::MedialSurfaceMeshFilter<ImageType>;
  const auto   image = MakeWall<ImageType>(25);
  const double level = FindLevel(image.GetPointer(), 150, true);
  const auto   mask = MakeSmoothedMask(
    image.GetPointer(), [](short pixel) { return static_cast<double>(pixel); }, [=](double f) { return f >= level; });
  const auto surface = SurfaceFilter::New();
  surface->SetInput(image);
  surface->SetThicknessMode(Mode::Automatic);
  surface->SetLowerThreshold(150);
  EXPECT_EQ(surface->GetSmoothing(), Smoothing::Automatic);
  surface->Update();
  const auto plain = itk::MedialSurfaceMeshFilter<Input<unsigned char, 3>>::New();
  plain->SetInput(mask);
  plain->SetThicknessMode(Mode::Automatic);
  plain->SetSmoothing(Smoothing::Off);
  plain->Update();
  ASSERT_GT(surface->GetOutput()->GetNumberOfPoints(), 100u);
  EXPECT_EQ(surface->GetOutput()->GetNumberOfPoints(), plain->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(surface->GetOutput()->GetNumberOfCells(), plain->GetOutput()->GetNumberOfCells());
}
