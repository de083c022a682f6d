// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// MaximumPoreSize of the filters: what they compute is what they compute of the cleaned volume, for any division.

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialSurfaceMeshFilter.h"

#include "MedialVoxelTestMesh.h"
#include "MedialVoxelTestPores.h"
#include "MedialVoxelTestRuns.h"

#include "itkStreamingImageFilter.h"

#include <cmath>

namespace
{
using namespace MedialVoxelTest;
using Mode = itk::MedialVoxelThicknessMode;

const Vector3 SkewSpacing{ { 0.7, 1.1, 1.3 } };

/** All that a run of the filter tells. */
struct Outcome
{
  std::vector<unsigned char> labels;
  std::vector<float>         thickness;
  Counts                     counts;
  std::size_t                filled;
  std::size_t                removed;
};

template <unsigned int D>
typename MedialFilter<D>::Pointer
MakePoreFilter(const Volume & volume, Mode mode, itk::SizeValueType poreSize)
{
  auto filter = MakeMedialFilter<D>(volume, 2.1);
  filter->SetThicknessMode(mode);
  filter->SetMaximumPoreSize(poreSize);
  filter->GenerateThicknessOn();
  return filter;
}

template <unsigned int D>
Outcome
OutcomeOf(MedialFilter<D> & filter)
{
  return { PixelsOf(filter.GetOutput()),
           PixelsOf(filter.GetThicknessOutput()),
           CountsOf(&filter),
           filter.GetCounts().filledVoxels,
           filter.GetCounts().removedVoxels };
}

template <unsigned int D>
Outcome
RunOn(const Volume & volume, Mode mode, itk::SizeValueType poreSize)
{
  const auto filter = MakePoreFilter<D>(volume, mode, poreSize);
  filter->Update();
  return OutcomeOf<D>(*filter);
}

void
ExpectSame(const Outcome & actual, const Outcome & expected)
{
  EXPECT_TRUE(AreEqual(actual.labels, expected.labels));
  EXPECT_TRUE(AreEqual(actual.thickness, expected.thickness));
  EXPECT_EQ(actual.counts, expected.counts);
  EXPECT_EQ(actual.filled, expected.filled);
  EXPECT_EQ(actual.removed, expected.removed);
}

/** The run of the cleaned volume without pores to look for, and with the counts of what was cleaned. */
template <unsigned int D>
void
ExpectThatOfTheCleanVolume(const Volume & volume, Mode mode, std::size_t poreSize)
{
  const Volume clean = WithoutPores(volume, poreSize);
  Outcome      expected = RunOn<D>(clean, mode, 0);
  EXPECT_EQ(expected.filled + expected.removed, 0u);
  expected.filled = VoxelsOnlyIn(clean, volume);
  expected.removed = VoxelsOnlyIn(volume, clean);
  EXPECT_GT(expected.filled + expected.removed, 0u);
  ExpectSame(RunOn<D>(volume, mode, poreSize), expected);
}
} // namespace

TEST(MedialVoxelPores, TheResultIsThatOfTheCleanVolume)
{
  unsigned int seed = 900;
  for (const Mode mode : { Mode::Fixed, Mode::Automatic })
  {
    for (const std::size_t poreSize : { 1u, 8u, 32u })
    {
      const auto length = static_cast<int>(poreSize);
      ExpectThatOfTheCleanVolume<3>(VolumeWithPores({ { 50, 44, 40 } }, UnitSpacing, length, ++seed), mode, poreSize);
      ExpectThatOfTheCleanVolume<3>(VolumeWithPores({ { 70, 30, 20 } }, SkewSpacing, length, ++seed), mode, poreSize);
      ExpectThatOfTheCleanVolume<2>(VolumeWithPores({ { 80, 70, 1 } }, SkewSpacing, length, ++seed), mode, poreSize);
    }
  }
}

TEST(MedialVoxelPores, DivisionsDoNotMatter)
{
  unsigned int seed = 930;
  for (const itk::SizeValueType poreSize : { 5u, 32u })
  {
    const Volume volume = VolumeWithPores({ { 72, 37, 44 } }, UnitSpacing, static_cast<int>(poreSize), ++seed);
    const auto   expected = RunOn<3>(volume, Mode::Automatic, poreSize);
    for (const auto & sizes : { std::make_pair(5u, 3u), { 8u, 64u }, { 64u, 1u } })
    {
      const auto filter = MakePoreFilter<3>(volume, Mode::Automatic, poreSize);
      itk::MedialVoxelFilterAccess::SetTileSize(*filter, sizes.first);
      itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, sizes.second);
      filter->SetNumberOfWorkUnits(sizes.second);
      filter->Update();
      ExpectSame(OutcomeOf<3>(*filter), expected);
    }
    const auto limited = MakePoreFilter<3>(volume, Mode::Automatic, poreSize);
    limited->SetNumberOfWorkUnits(1);
    limited->SetWorkingMemoryLimit(24 << 20);
    limited->Update();
    ExpectSame(OutcomeOf<3>(*limited), expected);
  }
}

TEST(MedialVoxelPores, StreamedPiecesAddUp)
{
  for (const Volume & volume : { VolumeWithPores({ { 60, 37, 40 } }, UnitSpacing, 12, 951),
                                 VolumeWithPores({ { 41, 33, 38 } }, { { 0.957, 0.957, 1.5 } }, 12, 952) })
  {
    const auto expected = RunOn<3>(volume, Mode::Automatic, 12);
    const auto filter = MakePoreFilter<3>(volume, Mode::Automatic, 12);
    for (const unsigned int divisions : { 3u, 38u })
    {
      auto streamer = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
      streamer->SetInput(filter->GetOutput());
      streamer->SetNumberOfStreamDivisions(divisions);
      filter->Modified();
      streamer->Update();
      EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), expected.labels));
      EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
      EXPECT_EQ(filter->GetCounts().filledVoxels, expected.filled);
      EXPECT_EQ(filter->GetCounts().removedVoxels, expected.removed);
    }
  }
}

TEST(MedialVoxelPores, RegionsOfAnyPlaceHoldTheSameLabels)
{
  const Volume volume = VolumeWithPores({ { 80, 45, 40 } }, UnitSpacing, 16, 960);
  const auto   expected = RunOn<3>(volume, Mode::Fixed, 16);
  std::mt19937 generator(961);
  for (int trial = 0; trial < 8; ++trial)
  {
    itk::ImageRegion<3> region;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      region.SetIndex(axis, generator() % volume.size[axis]);
      region.SetSize(axis, 1 + generator() % (volume.size[axis] - region.GetIndex(axis)));
    }
    const auto filter = MakePoreFilter<3>(volume, Mode::Fixed, 16);
    filter->UpdateOutputInformation();
    filter->GetOutput()->SetRequestedRegion(region);
    filter->Update();
    std::vector<unsigned char> labels;
    for (itk::ImageRegionConstIteratorWithIndex<MaskImage<3>> it(filter->GetOutput(), region); !it.IsAtEnd(); ++it)
    {
      const auto & v = it.GetIndex();
      labels.push_back(expected.labels[volume.Offset({ { int(v[0]), int(v[1]), int(v[2]) } })]);
    }
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), labels));
  }
}

TEST(MedialVoxelPores, TheDefaultDependsOnTheMode)
{
  const auto filter = MedialFilter<3>::New();
  EXPECT_EQ(filter->GetMaximumPoreSize(), 0u);
  filter->SetThicknessMode(Mode::Automatic);
  EXPECT_EQ(filter->GetMaximumPoreSize(), 32u);
  const auto time = filter->GetMTime();
  filter->SetMaximumPoreSize(0);
  EXPECT_EQ(filter->GetMaximumPoreSize(), 0u);
  EXPECT_GT(filter->GetMTime(), time);
  filter->UnsetMaximumPoreSize();
  EXPECT_EQ(filter->GetMaximumPoreSize(), 32u);
  filter->SetMaximumPoreSize(7);
  filter->SetThicknessMode(Mode::Fixed);
  EXPECT_EQ(filter->GetMaximumPoreSize(), 7u);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("MaximumPoreSize: 7\n"), std::string::npos);

  const Volume volume = VolumeWithPores({ { 50, 40, 30 } }, UnitSpacing, 32, 970);
  const auto   automatic = MakeMedialFilter<3>(volume, 3.0);
  automatic->SetThicknessMode(Mode::Automatic);
  automatic->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(automatic->GetOutput()), RunOn<3>(volume, Mode::Automatic, 32).labels));
  EXPECT_GT(automatic->GetCounts().filledVoxels, 0u);
  automatic->SetThicknessMode(Mode::Fixed);
  automatic->Update();
  EXPECT_EQ(automatic->GetCounts().filledVoxels, 0u);
}

TEST(MedialVoxelPores, TooLargeASizeIsRefused)
{
  const auto filter = MakePoreFilter<3>(VolumeWithPores({ { 20, 20, 20 } }, UnitSpacing, 5, 971), Mode::Fixed, 1000001);
  try
  {
    filter->Update();
    FAIL() << "not refused";
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find("MaximumPoreSize is 1000001; it must not exceed 1000000"),
              std::string::npos);
  }
  filter->SetMaximumPoreSize(1000000);
  EXPECT_NO_THROW(filter->Update());
}

TEST(MedialVoxelPores, VectorsAreThoseOfTheCleanVolume)
{
  const Volume volume = VolumeWithPores({ { 50, 40, 30 } }, UnitSpacing, 20, 980);
  for (const auto boundary : { itk::MedialVoxelBoundary::Object, itk::MedialVoxelBoundary::Background })
  {
    const auto vectorsOf = [&](const Volume & input, itk::SizeValueType poreSize) {
      const auto filter = MakePoreFilter<3>(input, Mode::Fixed, poreSize);
      filter->GenerateVectorDistanceOn();
      filter->SetVectorDistanceBoundary(boundary);
      filter->Update();
      return PixelsOf(filter->GetVectorDistanceOutput());
    };
    EXPECT_TRUE(VectorsAreEqual(vectorsOf(volume, 20), vectorsOf(WithoutPores(volume, 20), 0)));
  }
}

TEST(MedialVoxelPores, NotANumberIsBackgroundThatMayBeAPore)
{
  using ImageType = itk::Image<float, 3>;
  const Volume volume = AxisPlate({ { 20, 20, 20 } }, UnitSpacing, 2, 5, 9);
  const auto   image = MakeImage<ImageType>(volume);
  image->SetPixel({ { 9, 9, 9 } }, std::numeric_limits<float>::quiet_NaN());
  const auto filter = itk::MedialVoxelImageFilter<ImageType>::New();
  filter->SetInput(image);
  filter->SetMaximumPoreSize(1);
  filter->Update();
  EXPECT_EQ(filter->GetCounts().notANumberVoxels, 1u);
  EXPECT_EQ(filter->GetCounts().filledVoxels, 1u);
  EXPECT_EQ(filter->GetCounts().objectVoxels, 20u * 20u * 9u);
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), RunMedialFilter<3>(volume, 3.0).labels));
}

TEST(MedialVoxelPores, ThicknessOnGrayValuesDoesNotDependOnDivisions)
{
  using ImageType = itk::Image<float, 3>;
  const Volume volume = VolumeWithPores({ { 60, 40, 36 } }, SkewSpacing, 9, 990);
  const auto   image = MakeImage<ImageType>(volume);
  std::mt19937 generator(991);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetLargestPossibleRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(it.Get() + static_cast<float>(generator() % 1000) / 2100.0f - 0.238f);
  }
  std::vector<float> expected;
  for (const unsigned int slab : { 0u, 1u, 7u })
  {
    const auto filter = itk::MedialVoxelImageFilter<ImageType>::New();
    filter->SetInput(image);
    filter->SetLowerThreshold(0.5);
    filter->SetThicknessMode(Mode::Automatic);
    filter->SetMaximumPoreSize(9);
    filter->GenerateThicknessOn();
    filter->SubvoxelThicknessOn();
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, slab);
    filter->Update();
    EXPECT_GT(filter->GetCounts().filledVoxels, 0u);
    const auto thickness = PixelsOf(filter->GetThicknessOutput());
    expected = slab == 0 ? thickness : expected;
    EXPECT_TRUE(AreEqual(thickness, expected));
    EXPECT_TRUE(std::all_of(thickness.begin(), thickness.end(), [](float value) { return std::isfinite(value); }));
    EXPECT_TRUE(std::any_of(thickness.begin(), thickness.end(), [](float value) { return value > 0.0f; }));
  }
}

TEST(MedialVoxelPores, MeshesAreThoseOfTheCleanVolume)
{
  const Volume volume = VolumeWithPores({ { 50, 40, 30 } }, UnitSpacing, 20, 995);
  const auto   numbersOf = [](const Volume & input, itk::SizeValueType poreSize, unsigned int slices) {
    using FilterType = itk::MedialSurfaceMeshFilter<MaskImage<3>, MeshType>;
    const auto filter = FilterType::New();
    filter->SetThicknessMode(Mode::Automatic);
    EXPECT_EQ(filter->GetMaximumPoreSize(), 32u);
    filter->SetMaximumPoreSize(poreSize);
    filter->SetSmoothing(itk::MedialVoxelSmoothing::Off);
    filter->SetInput(MakeImage<MaskImage<3>>(input));
    filter->SetNumberOfSlicesPerPiece(slices);
    filter->Update();
    auto numbers = NumbersOf(*filter->GetOutput());
    EXPECT_EQ(filter->GetMaximumPoreSize(), poreSize);
    filter->UnsetMaximumPoreSize();
    EXPECT_EQ(filter->GetMaximumPoreSize(), 32u);
    return numbers;
  };
  const auto expected = numbersOf(WithoutPores(volume, 20), 0, 0);
  EXPECT_GT(expected.size(), 300u);
  EXPECT_TRUE(AreEqual(numbersOf(volume, 20, 0), expected));
  EXPECT_TRUE(AreEqual(numbersOf(volume, 20, 3), expected));
  EXPECT_FALSE(AreEqual(numbersOf(volume, 0, 0), expected));
}
