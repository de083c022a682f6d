// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The thickness output of the medial voxel filter: where it is, what it holds, how little input it needs.

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialVoxelImageFilter.h"

#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestThickness.h"

#include "itkStreamingImageFilter.h"

#include <sstream>

namespace
{
using namespace MedialVoxelTest;

using Thicknesses = MedialFilter<3>::ThicknessImageType;

template <unsigned int D>
typename MedialFilter<D>::Pointer
MakeThicknessFilter(const Volume & volume, double tau)
{
  auto filter = MakeMedialFilter<D>(volume, tau);
  filter->GenerateThicknessOn();
  return filter;
}

template <unsigned int D>
void
ExpectDefinition(const Volume & volume, double tau)
{
  auto filter = MakeThicknessFilter<D>(volume, tau);
  filter->Update();
  const auto  labels = PixelsOf(filter->GetOutput());
  const auto  thicknesses = PixelsOf(filter->GetThicknessOutput());
  const auto  sites = BoundarySites(volume);
  const auto  nearest = NearestBoundaryPoints(volume, sites);
  std::size_t medial = 0;
  std::size_t rims = 0;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] < 2)
    {
      ASSERT_EQ(thicknesses[i], 0.0f);
      continue;
    }
    ++medial;
    const ExpectedWall wall = ExpectWall(volume, sites, nearest, volume.IndexAt(i));
    ASSERT_NEAR(std::abs(thicknesses[i]), wall.thickness, 1e-5) << i;
    if (std::abs(wall.cosine - 0.8) > 1e-9)
    {
      ASSERT_EQ(thicknesses[i] < 0.0f, wall.cosine < 0.8) << i << ' ' << wall.cosine;
      rims += thicknesses[i] < 0.0f ? 1 : 0;
    }
  }
  EXPECT_GT(medial, 20u);
  EXPECT_GT(rims, 0u);
  EXPECT_LT(rims, medial);
}
} // namespace

TEST(MedialVoxelThicknessOutput, IsWhatItsDefinitionSays)
{
  ExpectDefinition<3>(RandomBoxes({ { 34, 26, 22 } }, UnitSpacing, 14, 91), 3.0);
  ExpectDefinition<3>(RandomBoxes({ { 24, 22, 20 } }, { { 0.9, 1.3, 0.7 } }, 14, 92), 2.5);
  ExpectDefinition<3>(RandomBoxes({ { 40, 30, 1 } }, { { 0.9, 1.3, 0.7 } }, 10, 93), 2.5);
  ExpectDefinition<2>(RandomBoxes({ { 40, 30, 1 } }, UnitSpacing, 10, 94), 2.5);
}

TEST(MedialVoxelThicknessOutput, IsExactForPlatesAlongAnAxis)
{
  const Vector3 spacing{ { 0.5, 0.75, 1.5 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int thickness = 1; thickness <= 8; ++thickness)
    {
      const Volume volume = AxisPlate({ { 16, 15, 17 } }, spacing, axis, 4, thickness);
      for (const bool isPhysical : { true, false })
      {
        auto filter = MakeThicknessFilter<3>(volume, 1.5);
        filter->SetUseImageSpacing(isPhysical);
        filter->Update();
        const auto   thicknesses = PixelsOf(filter->GetThicknessOutput());
        const auto   labels = PixelsOf(filter->GetOutput());
        const double expected = thickness * (isPhysical ? spacing[axis] : 1.0);
        std::size_t  inside = 0;
        for (std::size_t i = 0; i < labels.size(); ++i)
        {
          EXPECT_EQ(thicknesses[i], labels[i] >= 2 ? static_cast<float>(expected) : 0.0f);
          inside += labels[i] >= 2 ? 1 : 0;
        }
        EXPECT_GT(inside, 100u);
      }
    }
  }
}

TEST(MedialVoxelThicknessOutput, ComesAndGoes)
{
  const Volume volume = RandomBoxes({ { 20, 18, 16 } }, UnitSpacing, 9, 95);
  auto         filter = MakeMedialFilter<3>(volume, 3.0);
  EXPECT_FALSE(filter->GetGenerateThickness());
  EXPECT_EQ(filter->GetThicknessOutput(), nullptr);
  filter->Update();
  const auto labels = PixelsOf(filter->GetOutput());
  const auto time = filter->GetMTime();
  filter->GenerateThicknessOn();
  EXPECT_GT(filter->GetMTime(), time);
  ASSERT_NE(filter->GetThicknessOutput(), nullptr);
  filter->GenerateVectorDistanceOn();
  EXPECT_EQ(filter->GetNumberOfOutputs(), 3u);
  EXPECT_EQ(filter->GetNumberOfIndexedOutputs(), 1u);
  filter->Update();
  EXPECT_EQ(filter->GetThicknessOutput()->GetBufferedRegion(), filter->GetOutput()->GetBufferedRegion());
  EXPECT_EQ(PixelsOf(filter->GetOutput()), labels);
  filter->GenerateThicknessOff();
  EXPECT_EQ(filter->GetThicknessOutput(), nullptr);
  EXPECT_NE(filter->GetVectorDistanceOutput(), nullptr);
  filter->Update();
  EXPECT_EQ(PixelsOf(filter->GetOutput()), labels);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("GenerateThickness: Off"), std::string::npos);
}

TEST(MedialVoxelThicknessOutput, HasTheGeometryOfTheLabels)
{
  auto image = MakeImage<MaskImage<3>>(RandomBoxes({ { 14, 12, 1 } }, { { 0.8, 0.9, 1.2 } }, 9, 96), 5);
  MaskImage<3>::DirectionType direction;
  direction.Fill(0.0);
  direction[0][1] = -1.0;
  direction[1][0] = 1.0;
  direction[2][2] = 1.0;
  image->SetDirection(direction);
  auto filter = MedialFilter<3>::New();
  filter->SetInput(image);
  filter->GenerateThicknessOn();
  filter->GenerateVectorDistanceOn();
  filter->Update();
  const auto * labels = filter->GetOutput();
  const auto * thickness = filter->GetThicknessOutput();
  EXPECT_NE(thickness->GetOrigin(), image->GetOrigin());
  EXPECT_EQ(thickness->GetOrigin(), labels->GetOrigin());
  EXPECT_EQ(thickness->GetSpacing(), labels->GetSpacing());
  EXPECT_EQ(thickness->GetDirection(), labels->GetDirection());
  EXPECT_EQ(thickness->GetLargestPossibleRegion(), labels->GetLargestPossibleRegion());
  EXPECT_EQ(filter->GetVectorDistanceOutput()->GetOrigin(), image->GetOrigin());
}

TEST(MedialVoxelThicknessOutput, ARequestOnItIsARequestOnAll)
{
  auto filter = MakeThicknessFilter<3>(RandomBoxes({ { 14, 12, 11 } }, UnitSpacing, 9, 97), 3.0);
  filter->UpdateOutputInformation();
  const itk::ImageRegion<3> region({ { 2, 3, 4 } }, { { 5, 4, 3 } });
  filter->GetThicknessOutput()->SetRequestedRegion(region);
  filter->GetThicknessOutput()->PropagateRequestedRegion();
  filter->GetThicknessOutput()->UpdateOutputData();
  EXPECT_EQ(filter->GetOutput()->GetBufferedRegion(), region);
  EXPECT_EQ(filter->GetThicknessOutput()->GetBufferedRegion(), region);
}

TEST(MedialVoxelThicknessOutput, StreamsAndReadsTheInputOnce)
{
  const Volume volume = AxisPlate({ { 70, 24, 96 } }, UnitSpacing, 1, 9, 3);
  auto         whole = MakeThicknessFilter<3>(volume, 3.0);
  whole->Update();
  for (const unsigned int divisions : { 1u, 7u, 96u })
  {
    auto source = RecordingSource<MaskImage<3>>::New();
    source->SetImage(MakeImage<MaskImage<3>>(volume));
    auto filter = MedialFilter<3>::New();
    filter->SetInput(source->GetOutput());
    filter->GenerateThicknessOn();
    auto streamer = itk::StreamingImageFilter<Thicknesses, Thicknesses>::New();
    streamer->SetInput(filter->GetThicknessOutput());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), PixelsOf(whole->GetThicknessOutput())));
    std::size_t asked = 0;
    for (const auto & region : source->GetRequests())
    {
      asked += region.GetNumberOfPixels();
    }
    EXPECT_EQ(asked, volume.object.size());
  }
}

TEST(MedialVoxelThicknessOutput, WallsThickerThanTheWindowAreMeasuredInAnyCut)
{
  // Boundary points lie up to 20 voxels away, so that tiles are run again with more around them.
  const Volume volume = TiltedPlate({ { 56, 50, 60 } }, { { 28.1, 25.3, 29.6 } }, { { 0.2, 0.4, 1.0 } }, 40.0);
  auto         reference = MakeThicknessFilter<3>(volume, 3.0);
  reference->Update();
  const auto expected = PixelsOf(reference->GetThicknessOutput());
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 39.0f);
  for (const auto & cut : { std::make_pair(3u, 7u), { 1u, 5u }, { 64u, 64u } })
  {
    auto filter = MakeThicknessFilter<3>(volume, 3.0);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, cut.first);
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, cut.second);
    filter->SetNumberOfWorkUnits(3);
    filter->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetThicknessOutput()), expected));
  }
  auto limited = MakeThicknessFilter<3>(volume, 3.0);
  limited->SetNumberOfWorkUnits(1);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*limited, 2);
  limited->SetWorkingMemoryLimit(itk::SizeValueType{ 6 } << 20);
  limited->Update();
  EXPECT_GT(itk::MedialVoxelFilterAccess::GetSums(*limited).recomputedVoxels, 0u);
  EXPECT_TRUE(AreEqual(PixelsOf(limited->GetThicknessOutput()), expected));
}

TEST(MedialVoxelThicknessOutput, WithoutObjectOrBoundaryIsZero)
{
  for (const bool isObject : { false, true })
  {
    auto filter =
      MakeThicknessFilter<3>(MakeVolume({ { 9, 8, 7 } }, UnitSpacing, [=](auto &) { return isObject; }), 3.0);
    filter->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetThicknessOutput()), std::vector<float>(9 * 8 * 7, 0.0f)));
  }
}
