// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The same pixels and counts for configurations drawn at random: volume, tiles, slabs, work units, requested regions
// and divisions together (invariant I2). MEDIALVOXEL_TEST_SEED sets the seed; each --gtest_repeat iteration draws anew.

#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkImageRegionSplitterMultidimensional.h"
#include "itkStreamingImageFilter.h"

#include <cstdlib>

namespace
{
using namespace MedialVoxelTest;

constexpr unsigned int NumberOfDraws = 60;

unsigned int
NextSeed()
{
  static unsigned int numberOfCalls = 0;
  const char * const  text = std::getenv("MEDIALVOXEL_TEST_SEED");
  const unsigned int  first = text ? static_cast<unsigned int>(std::strtoul(text, nullptr, 10)) : 20261121u;
  return first + 1000u * numberOfCalls++;
}

using Generator = std::mt19937;

int
Roll(Generator & generator, int low, int high)
{
  return low + static_cast<int>(generator() % static_cast<unsigned int>(high - low + 1));
}

template <unsigned int D>
Volume
DrawVolume(Generator & generator)
{
  const int    longest = D == 2 ? 150 : 45;
  const Index3 size{
    { Roll(generator, 1, longest + 90 / D), Roll(generator, 1, longest), D == 2 ? 1 : Roll(generator, 1, longest) }
  };
  const Vector3 spacing =
    Roll(generator, 0, 1) != 0 ? UnitSpacing : Vector3{ { 0.5, 0.25 * Roll(generator, 1, 6), D == 2 ? 1.0 : 0.75 } };
  return RandomBoxes(size, spacing, Roll(generator, 1, 30), generator());
}

template <unsigned int D>
itk::ImageRegion<D>
DrawRegion(Generator & generator, const itk::ImageRegion<D> & whole)
{
  itk::ImageRegion<D> region;
  for (unsigned int axis = 0; axis < D; ++axis)
  {
    const int size = static_cast<int>(whole.GetSize(axis));
    const int first = Roll(generator, 0, size - 1);
    region.SetIndex(axis, whole.GetIndex(axis) + first);
    region.SetSize(axis, static_cast<itk::SizeValueType>(Roll(generator, 1, size - first)));
  }
  return region;
}

template <typename TFilter>
void
DrawCuts(Generator & generator, TFilter * filter)
{
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, static_cast<unsigned int>(Roll(generator, 0, 70)));
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, static_cast<unsigned int>(Roll(generator, 0, 50)));
  filter->SetNumberOfWorkUnits(static_cast<itk::ThreadIdType>(Roll(generator, 1, 5)));
}

template <typename TImage>
std::vector<typename TImage::PixelType>
Cut(const TImage * image, const typename TImage::RegionType & region)
{
  std::vector<typename TImage::PixelType> pixels;
  for (itk::ImageRegionConstIteratorWithIndex<TImage> it(image, region); !it.IsAtEnd(); ++it)
  {
    pixels.push_back(it.Get());
  }
  return pixels;
}

/** Any regions of a filter, overlapping or not, in any order, are those of the whole. */
template <typename TFilter, typename TImage>
void
ExpectRegions(Generator & generator, TFilter * filter, const TImage * whole)
{
  filter->UpdateOutputInformation();
  for (int i = 0; i < 4; ++i)
  {
    const auto region = DrawRegion(generator, whole->GetLargestPossibleRegion());
    filter->GetOutput()->SetRequestedRegion(region);
    filter->Update();
    // A region inside the one before is there already.
    EXPECT_TRUE(filter->GetOutput()->GetBufferedRegion().IsInside(region));
    EXPECT_TRUE(AreEqual(Cut(filter->GetOutput(), region), Cut(whole, region))) << region;
  }
}

template <typename TFilter>
typename TFilter::OutputImageType::Pointer
Stream(Generator & generator, TFilter * filter)
{
  using ImageType = typename TFilter::OutputImageType;
  auto streamer = itk::StreamingImageFilter<ImageType, ImageType>::New();
  streamer->SetInput(filter->GetOutput());
  streamer->SetRegionSplitter(itk::ImageRegionSplitterMultidimensional::New());
  streamer->SetNumberOfStreamDivisions(static_cast<unsigned int>(Roll(generator, 1, 60)));
  streamer->Update();
  return streamer->GetOutput();
}

template <unsigned int D>
void
CompareMedial(unsigned int seed)
{
  Generator    generator(seed);
  const Volume volume = DrawVolume<D>(generator);
  const double thickness = 0.5 * Roll(generator, 1, 12);
  auto         reference = MakeMedialFilter<D>(volume, thickness);
  reference->SetNumberOfWorkUnits(1);
  reference->Update();
  auto filter = MakeMedialFilter<D>(volume, thickness);
  DrawCuts(generator, filter.GetPointer());
  const auto streamed = Stream(generator, filter.GetPointer());
  EXPECT_TRUE(AreEqual(PixelsOf(streamed.GetPointer()), PixelsOf(reference->GetOutput())));
  EXPECT_EQ(CountsOf(filter.GetPointer()), CountsOf(reference.GetPointer()));
  ExpectRegions(generator, filter.GetPointer(), reference->GetOutput());
}

template <unsigned int D>
void
CompareDistance(unsigned int seed)
{
  Generator    generator(seed);
  const Volume volume = DrawVolume<D>(generator);
  const bool   isBackground = Roll(generator, 0, 1) != 0;
  const double maximum = Roll(generator, 0, 1) != 0 ? 6.5 : std::numeric_limits<double>::infinity();
  const auto   make = [&] {
    auto filter = VectorFilter<D>::New();
    filter->SetInput(MakeImage<MaskImage<D>>(volume));
    filter->SetBoundary(isBackground ? itk::MedialVoxelBoundary::Background : itk::MedialVoxelBoundary::Object);
    filter->SetMaximumDistance(maximum);
    return filter;
  };
  auto reference = make();
  reference->SetNumberOfWorkUnits(1);
  reference->Update();
  auto filter = make();
  DrawCuts(generator, filter.GetPointer());
  const auto streamed = Stream(generator, filter.GetPointer());
  EXPECT_TRUE(VectorsAreEqual(PixelsOf(streamed.GetPointer()), PixelsOf(reference->GetOutput())));
}

template <typename TCompare>
void
RepeatDraws(TCompare && compare)
{
  const unsigned int first = NextSeed();
  for (unsigned int seed = first; seed < first + NumberOfDraws && !::testing::Test::HasFailure(); ++seed)
  {
    SCOPED_TRACE("MEDIALVOXEL_TEST_SEED=" + std::to_string(seed));
    compare(seed);
  }
}
} // namespace

TEST(MedialVoxelRandomIdentity, MedialVoxels2D)
{
  RepeatDraws(CompareMedial<2>);
}

TEST(MedialVoxelRandomIdentity, MedialVoxels3D)
{
  RepeatDraws(CompareMedial<3>);
}

TEST(MedialVoxelRandomIdentity, Distances2D)
{
  RepeatDraws(CompareDistance<2>);
}

TEST(MedialVoxelRandomIdentity, Distances3D)
{
  RepeatDraws(CompareDistance<3>);
}
