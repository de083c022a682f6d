// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The automatic thickness of the filter: definition, units, divisions, mirrored inputs.

#include "MedialVoxelTestAutomatic.h"
#include "MedialVoxelTestPores.h"
#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkStreamingImageFilter.h"

namespace
{
using namespace MedialVoxelTest;
using Mode = itk::MedialVoxelThicknessMode;

const Vector3 SkewSpacing{ { 0.7, 1.1, 1.3 } };

template <unsigned int D>
typename MedialFilter<D>::Pointer
MakeAutomaticFilter(const Volume & volume, double minimum, double maximum)
{
  auto filter = MakeMedialFilter<D>(volume, 3.0);
  filter->SetThicknessMode(Mode::Automatic);
  filter->SetMinimumThickness(minimum);
  filter->SetMaximumThickness(maximum);
  return filter;
}

template <unsigned int D>
Classification
RunAutomatically(const Volume & volume, double minimum = 0.0, double maximum = 0.0)
{
  auto filter = MakeAutomaticFilter<D>(volume, minimum, maximum);
  filter->UpdateLargestPossibleRegion();
  return { PixelsOf(filter->GetOutput()), CountsOf(filter.GetPointer()) };
}

/** Plates of 2 and of 10 voxels, one above the other, that the volume cuts. */
Volume
TwoPlates()
{
  return MakeVolume({ { 70, 40, 36 } }, UnitSpacing, [](const Index3 & v) {
    return v[0] >= 4 && v[0] < 66 && ((v[2] >= 5 && v[2] < 7) || (v[2] >= 14 && v[2] < 24));
  });
}

/** The same cells in a mirrored volume, where no cell around has a tie; tells how many there were. */
std::size_t
ExpectLabelsMirrored(const Volume & volume, double minimum, double maximum)
{
  const auto tieFree = Classifier(volume, 3.0).TieFreeCells();
  const auto labels = RunAutomatically<3>(volume, minimum, maximum).labels;
  const auto isUsable = [&](const Index3 & cell) {
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      const bool isNear = PhysicalDistance(volume, cell, volume.IndexAt(i)) <= maximum / 2;
      if (isNear && !tieFree[i] && IsCandidate(volume, volume.IndexAt(i)))
      {
        return false;
      }
    }
    return IsCandidate(volume, cell);
  };
  std::array<std::vector<unsigned char>, 3> mirrored;
  for (int axis = 0; axis < 3; ++axis)
  {
    mirrored[axis] = RunAutomatically<3>(Mirrored(volume, axis), minimum, maximum).labels;
  }
  std::size_t usable = 0;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const Index3 cell = volume.IndexAt(i);
    if (!isUsable(cell))
    {
      continue;
    }
    ++usable;
    for (int axis = 0; axis < 3; ++axis)
    {
      Index3 image = cell;
      image[axis] = std::max(0, volume.size[axis] - 2) - cell[axis];
      EXPECT_EQ(mirrored[axis][volume.Offset(image)], labels[i]);
    }
  }
  return usable;
}
} // namespace

TEST(MedialVoxelAutomaticThickness, TheFilterFollowsTheDefinition)
{
  const Volume boxes = RandomBoxes({ { 30, 25, 21 } }, SkewSpacing, 13, 601);
  const Volume cleanBoxes = WithoutPores(boxes, 32);
  const auto   solid = JointClassifier(cleanBoxes, { 2.1, 8.3 }).Run(Bound::FreeSpace);
  EXPECT_TRUE(AreEqual(RunAutomatically<3>(boxes, 2.1, 8.3).labels, solid.labels));
  EXPECT_EQ(RunAutomatically<3>(boxes, 2.1, 8.3).counts, solid.counts);
  const Volume flat = RandomBoxes({ { 60, 55, 1 } }, UnitSpacing, 17, 602);
  const Volume cleanFlat = WithoutPores(flat, 32);
  const auto   plane = JointClassifier(cleanFlat, { 3.0, 16.0 }).Run(Bound::FreeSpace);
  EXPECT_TRUE(AreEqual(RunAutomatically<2>(flat, 3.0, 16.0).labels, plane.labels));
  EXPECT_GT(plane.counts.geodesicMedialCells, 50u);
}

TEST(MedialVoxelAutomaticThickness, DefaultsAreVoxelsOfTheSmallestSpacing)
{
  const Volume boxes = RandomBoxes({ { 30, 25, 21 } }, SkewSpacing, 13, 603);
  const auto   labels = RunAutomatically<3>(boxes).labels;
  EXPECT_TRUE(AreEqual(labels, RunAutomatically<3>(boxes, 3 * SkewSpacing[0], 16 * SkewSpacing[0]).labels));
  EXPECT_FALSE(AreEqual(labels, RunAutomatically<3>(boxes, 6 * SkewSpacing[0], 16 * SkewSpacing[0]).labels));
  auto inVoxels = MakeAutomaticFilter<3>(boxes, 0.0, 0.0);
  inVoxels->UseImageSpacingOff();
  inVoxels->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(inVoxels->GetOutput()), RunAutomatically<3>(InVoxelUnits(boxes), 3.0, 16.0).labels));
}

TEST(MedialVoxelAutomaticThickness, DivisionsDoNotMatter)
{
  for (const Volume & volume : { TwoPlates(),
                                 RandomBoxes({ { 75, 37, 29 } }, UnitSpacing, 30, 604),
                                 RandomBoxes({ { 41, 33, 30 } }, { { 0.957, 0.957, 1.5 } }, 25, 605) })
  {
    const auto expected = RunAutomatically<3>(volume);
    for (const auto & sizes : { std::make_pair(5u, 3u), { 8u, 64u }, { 64u, 2u } })
    {
      auto filter = MakeAutomaticFilter<3>(volume, 0.0, 0.0);
      itk::MedialVoxelFilterAccess::SetTileSize(*filter, sizes.first);
      itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, sizes.second);
      filter->SetNumberOfWorkUnits(sizes.second);
      filter->Update();
      EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected.labels));
      EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
    }
    auto filter = MakeAutomaticFilter<3>(volume, 0.0, 0.0);
    auto streamer = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(7);
    streamer->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), expected.labels));
    EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
  }
}

TEST(MedialVoxelAutomaticThickness, MemoryLimitsDoNotMatter)
{
  const Volume volume = RandomBoxes({ { 75, 57, 49 } }, UnitSpacing, 40, 606);
  const auto   expected = RunAutomatically<3>(volume);
  auto         filter = MakeAutomaticFilter<3>(volume, 0.0, 0.0);
  filter->SetNumberOfWorkUnits(1);
  filter->SetWorkingMemoryLimit(24 << 20);
  filter->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected.labels));
}

TEST(MedialVoxelAutomaticThickness, LabelsMapInMirroredVolumes)
{
  EXPECT_GT(ExpectLabelsMirrored(RandomVolume({ { 12, 11, 10 } }, SkewSpacing, 0.75, 607), 0.9, 2.4), 5u);
  EXPECT_GT(ExpectLabelsMirrored(RandomVolume({ { 12, 11, 10 } }, SkewSpacing, 0.75, 608), 0.5, 1.6), 5u);
  const Volume slab = MakeVolume({ { 3, 3, 3 } }, SkewSpacing, [](const Index3 & v) {
    const int level = v[0] - v[1] + 3 * v[2] - 2;
    return level >= 0 && level < 6;
  });
  EXPECT_EQ(ExpectLabelsMirrored(slab, 0.9, 9.0), 8u);
}

TEST(MedialVoxelAutomaticThickness, BadLimitsAreRefused)
{
  const auto messageOf = [](double minimum, double maximum) {
    auto filter = MakeAutomaticFilter<3>(TwoPlates(), minimum, maximum);
    try
    {
      filter->Update();
    }
    catch (const itk::ExceptionObject & error)
    {
      return std::string(error.GetDescription());
    }
    return std::string();
  };
  EXPECT_NE(messageOf(-1.0, 0.0).find("MinimumThickness is -1"), std::string::npos);
  EXPECT_NE(messageOf(0.0, -2.0).find("MaximumThickness is -2"), std::string::npos);
  EXPECT_NE(messageOf(std::nan(""), 0.0).find("MinimumThickness is nan"), std::string::npos);
  EXPECT_NE(messageOf(17.0, 0.0).find("MinimumThickness is 17"), std::string::npos);
  EXPECT_NE(messageOf(5.0, 4.0).find("MaximumThickness, 4"), std::string::npos);
  EXPECT_EQ(messageOf(4.0, 4.0), "");
}

TEST(MedialVoxelAutomaticThickness, ModeIsFixedUnlessChosen)
{
  auto filter = MedialFilter<3>::New();
  EXPECT_EQ(filter->GetThicknessMode(), Mode::Fixed);
  EXPECT_EQ(filter->GetMinimumThickness(), 0.0);
  EXPECT_EQ(filter->GetMaximumThickness(), 0.0);
  filter->SetThicknessMode(Mode::Automatic);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("ThicknessMode: itk::MedialVoxelEnums::ThicknessMode::Automatic"), std::string::npos);
  std::ostringstream fixed;
  fixed << Mode::Fixed << static_cast<Mode>(9);
  EXPECT_EQ(fixed.str(),
            "itk::MedialVoxelEnums::ThicknessMode::FixedINVALID VALUE FOR itk::MedialVoxelEnums::ThicknessMode");
}
