// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Inputs at the ends of what is defined (invariant I10).

#include "itkMedialVoxelFilterAccess.h"

#include "MedialVoxelTestRuns.h"

namespace
{
using namespace MedialVoxelTest;

Volume
Full(const Index3 & size)
{
  return Complement(Volume(size, UnitSpacing));
}

/** Labels by every bound against brute force, and both kinds of vectors. */
template <unsigned int D>
void
ExpectOracle(const Volume & volume)
{
  for (const Bound bound : { Bound::FreeSpace, Bound::Paper, Bound::Off })
  {
    const auto expected = Classify(volume, 3.0, bound);
    const auto actual = RunMedialFilter<D>(volume, 3.0, bound);
    EXPECT_TRUE(AreEqual(actual.labels, expected.labels));
    EXPECT_EQ(actual.counts, expected.counts);
  }
  for (const BoundarySide side : { BoundarySide::Object, BoundarySide::Background })
  {
    auto filter = VectorFilter<D>::New();
    filter->SetInput(MakeImage<MaskImage<D>>(volume));
    filter->SetBoundary(side == BoundarySide::Object ? itk::MedialVoxelBoundary::Object
                                                     : itk::MedialVoxelBoundary::Background);
    filter->Update();
    const std::vector<unsigned char> everywhere(volume.object.size(), 1);
    EXPECT_TRUE(VectorsAreEqual(PixelsOf(filter->GetOutput()),
                                ExpectedVectors<D>(volume, BoundarySites(volume, side), everywhere)));
  }
}
} // namespace

TEST(MedialVoxelEdgeCase, EmptyImagesHaveNoCellsAndNoVectors)
{
  const Volume empty({ { 7, 6, 5 } }, UnitSpacing);
  const auto   run = RunMedialFilter<3>(empty, 3.0);
  EXPECT_EQ(run.labels, std::vector<unsigned char>(7 * 6 * 5, 0));
  EXPECT_EQ(run.counts, Counts());
  ExpectOracle<3>(empty);
}

TEST(MedialVoxelEdgeCase, FullImagesHaveNoMedialCellAndNaNVectors)
{
  const Volume full = Full({ { 7, 6, 5 } });
  const auto   run = RunMedialFilter<3>(full, 3.0);
  EXPECT_EQ(run.counts.objectVoxels, 210u);
  EXPECT_EQ(run.counts.boundaryVoxels, 0u);
  EXPECT_EQ(run.counts.candidateCells, 120u);
  EXPECT_EQ(run.counts.trivialCells, 120u);
  ExpectOracle<3>(full);
  auto filter = MakeMedialFilter<3>(full, 3.0);
  filter->GenerateVectorDistanceOn();
  filter->Update();
  for (const auto & vector : PixelsOf(filter->GetVectorDistanceOutput()))
  {
    EXPECT_TRUE(std::isnan(vector[0]) && std::isnan(vector[1]) && std::isnan(vector[2]));
  }
}

TEST(MedialVoxelEdgeCase, OneVoxelImagesHaveNoCell)
{
  const auto object = RunMedialFilter<3>(Full({ { 1, 1, 1 } }), 3.0);
  EXPECT_EQ(object.labels, std::vector<unsigned char>{ 0 });
  EXPECT_EQ(object.counts.objectVoxels, 1u);
  EXPECT_EQ(object.counts.candidateCells, 0u);
  ExpectOracle<3>(Full({ { 1, 1, 1 } }));
  ExpectOracle<3>(Volume({ { 1, 1, 1 } }, UnitSpacing));
  ExpectOracle<2>(Full({ { 1, 1, 1 } }));
}

TEST(MedialVoxelEdgeCase, OneObjectVoxelAnywhere)
{
  for (const Index3 & at : { Index3{ { 0, 0, 0 } }, Index3{ { 3, 2, 1 } }, Index3{ { 4, 3, 2 } } })
  {
    Volume volume({ { 5, 4, 3 } }, UnitSpacing);
    volume.Set(at, true);
    ExpectOracle<3>(volume);
    ExpectOracle<3>(Complement(volume));
  }
}

TEST(MedialVoxelEdgeCase, OneSliceIsAPlaneImage)
{
  const Vector3 spacing{ { 0.8, 1.0, 1.4 } };
  const Volume  plane = RandomBoxes({ { 17, 15, 1 } }, spacing, 6, 91);
  const auto    expected = RunMedialFilter<2>(plane, 2.0);
  ExpectOracle<2>(plane);
  for (int flat = 0; flat < 3; ++flat)
  {
    // The same slice as a volume with one axis of length 1, in all three positions.
    const Index3 order = flat == 0 ? Index3{ { 2, 0, 1 } } : flat == 1 ? Index3{ { 0, 2, 1 } } : Index3{ { 0, 1, 2 } };
    const Volume slice = Permuted(plane, order);
    ASSERT_EQ(slice.size[flat], 1);
    const auto actual = RunMedialFilter<3>(slice, 2.0);
    EXPECT_TRUE(AreEqual(actual.labels, expected.labels));
    EXPECT_EQ(actual.counts, expected.counts);
    ExpectOracle<3>(slice);
  }
}

TEST(MedialVoxelEdgeCase, OneRowIsALine)
{
  // Object at 2..5: boundary 1 and 6. Cells 2..5 see (1, 6) only where both corners disagree, in the middle.
  const Volume row = MakeVolume({ { 9, 1, 1 } }, UnitSpacing, [](const Index3 & v) { return v[0] >= 2 && v[0] <= 5; });
  for (int axis = 0; axis < 3; ++axis)
  {
    const Index3 order{ { axis == 0 ? 0 : 1, axis == 1 ? 0 : (axis == 0 ? 1 : 2), axis == 2 ? 0 : 2 } };
    const Volume line = Permuted(row, order);
    ASSERT_EQ(line.size[axis], 9);
    const std::vector<unsigned char> expected{ 0, 1, 1, 2, 1, 1, 0, 0, 0 };
    EXPECT_EQ(RunMedialFilter<3>(line, 3.0).labels, expected);
    ExpectOracle<3>(line);
  }
  ExpectOracle<2>(row);
  ExpectOracle<3>(RandomVolume({ { 200, 1, 1 } }, UnitSpacing, 0.8, 92));
  ExpectOracle<3>(RandomVolume({ { 1, 150, 1 } }, { { 0.5, 0.7, 0.9 } }, 0.9, 93));
  ExpectOracle<3>(RandomVolume({ { 1, 1, 150 } }, { { 0.5, 0.7, 0.9 } }, 0.9, 94));
}

TEST(MedialVoxelEdgeCase, TwoVoxelsMakeOneCell)
{
  for (const Index3 & size : { Index3{ { 2, 1, 1 } }, Index3{ { 2, 2, 1 } }, Index3{ { 2, 2, 2 } } })
  {
    for (unsigned int pattern = 0; pattern < 1u << size[0] * size[1] * size[2]; ++pattern)
    {
      const Volume volume = MakeVolume(size, UnitSpacing, [&](const Index3 & v) {
        return (pattern >> ((v[2] * size[1] + v[1]) * size[0] + v[0]) & 1) != 0;
      });
      ASSERT_TRUE(AreEqual(RunMedialFilter<3>(volume, 0.5).labels, Classify(volume, 0.5, Bound::FreeSpace).labels))
        << "pattern " << pattern;
    }
  }
}

TEST(MedialVoxelEdgeCase, TheEndOfTheImageIsNoBoundary)
{
  // A plate that touches the lower face has one boundary layer only, above it.
  const Volume plate = AxisPlate({ { 6, 6, 8 } }, UnitSpacing, 2, 0, 4);
  EXPECT_EQ(BoundarySites(plate).size(), 36u);
  const auto run = RunMedialFilter<3>(plate, 3.0);
  EXPECT_EQ(run.counts.boundaryVoxels, 36u);
  EXPECT_EQ(run.counts.boundCells + run.counts.geodesicMedialCells, 0u);
  ExpectOracle<3>(plate);
  ExpectOracle<3>(RandomBoxes({ { 8, 9, 7 } }, UnitSpacing, 3, 95));
}

TEST(MedialVoxelEdgeCase, StartIndexAndPlaceInSpaceDoNotMatter)
{
  const Volume volume = RandomBoxes({ { 70, 9, 8 } }, { { 0.9, 1.0, 1.3 } }, 14, 96);
  const auto   expected = RunMedialFilter<3>(volume, 2.5);
  for (const itk::IndexValueType start : { -100, -64, -1, 13, 1000000 })
  {
    auto         image = MakeImage<MaskImage<3>>(volume, start);
    const double origin[3] = { -310.5, 7.25, 1e5 };
    image->SetOrigin(origin);
    auto filter = MedialFilter<3>::New();
    filter->SetInput(image);
    filter->SetThickness(2.5);
    filter->GenerateVectorDistanceOn();
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, 16);
    filter->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), expected.labels)) << "start " << start;
    EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
    EXPECT_TRUE(
      VectorsAreEqual(PixelsOf(filter->GetVectorDistanceOutput()),
                      ExpectedVectors<3>(volume, BoundarySites(volume, BoundarySide::Object), volume.object)));
  }
}

TEST(MedialVoxelEdgeCase, DirectionChangesNothingButTheVectors)
{
  const Volume                volume = RandomBoxes({ { 12, 10, 9 } }, { { 0.9, 1.0, 1.3 } }, 6, 97);
  auto                        image = MakeImage<MaskImage<3>>(volume);
  MaskImage<3>::DirectionType oblique;
  oblique.Fill(0.0);
  oblique[0][0] = 0.36;
  oblique[0][1] = 0.48;
  oblique[0][2] = -0.8;
  oblique[1][0] = -0.8;
  oblique[1][1] = 0.6;
  oblique[2][0] = 0.48;
  oblique[2][1] = 0.64;
  oblique[2][2] = 0.6;
  image->SetDirection(oblique);
  auto filter = MedialFilter<3>::New();
  filter->SetInput(image);
  filter->GenerateVectorDistanceOn();
  filter->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), RunMedialFilter<3>(volume, 3.0).labels));
  const auto straight = ExpectedVectors<3>(volume, BoundarySites(volume, BoundarySide::Object), volume.object);
  const auto turned = PixelsOf(filter->GetVectorDistanceOutput());
  for (std::size_t i = 0; i < turned.size(); ++i)
  {
    for (unsigned int row = 0; row < 3; ++row)
    {
      const double expected =
        oblique[row][0] * straight[i][0] + oblique[row][1] * straight[i][1] + oblique[row][2] * straight[i][2];
      ASSERT_NEAR(turned[i][row], expected, 1e-5);
    }
  }
}

TEST(MedialVoxelEdgeCase, VoxelUnitsIgnoreTheDirection)
{
  const Volume                volume = RandomBoxes({ { 12, 10, 9 } }, { { 0.9, 1.0, 1.3 } }, 6, 98);
  auto                        image = MakeImage<MaskImage<3>>(volume);
  MaskImage<3>::DirectionType turned;
  turned.Fill(0.0);
  turned[0][1] = 1.0;
  turned[1][0] = -1.0;
  turned[2][2] = 1.0;
  image->SetDirection(turned);
  auto filter = VectorFilter<3>::New();
  filter->SetInput(image);
  filter->UseImageSpacingOff();
  filter->SetRegion(itk::MedialVoxelRegion::Inside);
  filter->Update();
  const Volume plain = InVoxelUnits(volume);
  EXPECT_TRUE(VectorsAreEqual(PixelsOf(filter->GetOutput()),
                              ExpectedVectors<3>(plain, BoundarySites(plain, BoundarySide::Object), plain.object)));
}
