// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Input is asked for as little as the result needs, also from piece to piece (invariant I8).

#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkStreamingImageFilter.h"

namespace
{
using namespace MedialVoxelTest;

using Source = RecordingSource<MaskImage<3>>;

Source::Pointer
MakeSource(const Volume & volume)
{
  auto source = Source::New();
  source->SetImage(MakeImage<MaskImage<3>>(volume));
  return source;
}

std::size_t
PixelsAsked(const Source * source)
{
  std::size_t pixels = 0;
  for (const auto & region : source->GetRequests())
  {
    pixels += region.GetNumberOfPixels();
  }
  return pixels;
}

/** A plate of three voxels that crosses the whole image. */
Volume
ThinVolume()
{
  return AxisPlate({ { 70, 24, 160 } }, UnitSpacing, 1, 9, 3);
}
} // namespace

TEST(MedialVoxelStreaming, ThinPartsAreReadOnceForAnyNumberOfPieces)
{
  const Volume volume = ThinVolume();
  const auto   expected = RunMedialFilter<3>(volume, 3.0);
  for (const unsigned int divisions : { 1u, 2u, 7u, 20u, 160u })
  {
    SCOPED_TRACE(divisions);
    auto source = MakeSource(volume);
    auto filter = MedialFilter<3>::New();
    filter->SetInput(source->GetOutput());
    auto streamer = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), expected.labels));
    EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
    EXPECT_EQ(PixelsAsked(source), volume.object.size());
    EXPECT_EQ(itk::MedialVoxelFilterAccess::GetSums(*filter).recomputedVoxels, 0u);
  }
}

TEST(MedialVoxelStreaming, VectorsOfANarrowBandAreReadOnce)
{
  const Volume volume = ThinVolume();
  auto         source = MakeSource(volume);
  auto         filter = VectorFilter<3>::New();
  filter->SetInput(source->GetOutput());
  filter->SetMaximumDistance(4.0);
  auto streamer = itk::StreamingImageFilter<VectorFilter<3>::VectorImageType, VectorFilter<3>::VectorImageType>::New();
  streamer->SetInput(filter->GetOutput());
  streamer->SetNumberOfStreamDivisions(10);
  streamer->Update();
  EXPECT_EQ(PixelsAsked(source), volume.object.size());
}

TEST(MedialVoxelStreaming, OnePieceAsksForItsWindowAlone)
{
  const Volume volume = ThinVolume();
  auto         source = MakeSource(volume);
  auto         filter = MedialFilter<3>::New();
  filter->SetInput(source->GetOutput());
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion(itk::ImageRegion<3>({ { 0, 0, 80 } }, { { 70, 24, 4 } }));
  filter->GetOutput()->PropagateRequestedRegion();
  filter->GetOutput()->UpdateOutputData();
  for (const auto & region : source->GetRequests())
  {
    // The halo: 8 voxels, half of epsilon, one voxel for the boundary; and one for the upper corners.
    EXPECT_GE(region.GetIndex(2), 80 - 12);
    EXPECT_LE(region.GetIndex(2) + static_cast<itk::IndexValueType>(region.GetSize(2)), 84 + 13);
  }
}

TEST(MedialVoxelStreaming, ThickSolidsAreComputedOnceAndAHalf)
{
  const Volume volume = Ball({ { 90, 80, 84 } }, UnitSpacing, { { 45, 40, 42 } }, 38);
  auto         filter = MakeMedialFilter<3>(volume, 3.0);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 8);
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 16);
  filter->UpdateLargestPossibleRegion();
  EXPECT_LE(itk::MedialVoxelFilterAccess::GetSums(*filter).recomputedVoxels, volume.object.size() / 2);
}

TEST(MedialVoxelStreaming, ChangedParametersAndInputsAreNotMissed)
{
  const Volume thin = ThinVolume();
  const Volume other = AxisPlate({ { 70, 24, 160 } }, UnitSpacing, 1, 12, 4);
  const auto   lower = itk::ImageRegion<3>({ { 0, 0, 0 } }, { { 70, 24, 80 } });
  const auto   upper = itk::ImageRegion<3>({ { 0, 0, 80 } }, { { 70, 24, 80 } });
  auto         source = MakeSource(thin);
  auto         filter = MedialFilter<3>::New();
  filter->SetInput(source->GetOutput());
  const auto run = [&](const itk::ImageRegion<3> & region) {
    filter->GetOutput()->SetRequestedRegion(region);
    filter->GetOutput()->PropagateRequestedRegion();
    filter->GetOutput()->UpdateOutputData();
    return PixelsOf(filter->GetOutput());
  };
  filter->UpdateOutputInformation();
  run(lower);
  // No new output information: only modification times tell that the window is of no use any more.
  filter->SetLowerThreshold(300);
  EXPECT_TRUE(AreEqual(run(upper), std::vector<unsigned char>(upper.GetNumberOfPixels(), 0)));

  filter->UnsetThresholds();
  filter->UpdateOutputInformation();
  run(lower);
  source->SetImage(MakeImage<MaskImage<3>>(other));
  filter->UpdateOutputInformation();
  const auto whole = RunMedialFilter<3>(other, 3.0).labels;
  EXPECT_TRUE(AreEqual(run(upper), { whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2), whole.end() }));
}

TEST(MedialVoxelStreaming, NotANumberIsCountedInTheRequestedRegionsAlone)
{
  using RealImage = itk::Image<float, 3>;
  const Volume volume = ThinVolume();
  auto         image = MakeImage<RealImage>(volume);
  std::size_t  number = 0;
  for (std::size_t i = 0; i < volume.object.size(); i += 37)
  {
    image->GetBufferPointer()[i] = std::numeric_limits<float>::quiet_NaN();
    ++number;
  }
  auto source = RecordingSource<RealImage>::New();
  source->SetImage(image);
  for (const unsigned int divisions : { 1u, 5u, 33u })
  {
    auto filter = itk::MedialVoxelImageFilter<RealImage>::New();
    filter->SetInput(source->GetOutput());
    auto streamer = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    EXPECT_EQ(filter->GetCounts().notANumberVoxels, number);
  }
}
