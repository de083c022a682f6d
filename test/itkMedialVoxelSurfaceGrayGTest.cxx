// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Surfaces measured on gray values: errors on clean parts, the same bytes in any cut, values that are not there.

#include "itkMedialSurfaceMeshFilter.h"

#include "MedialVoxelTestMesh.h"
#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestSurface.h"
#include "MedialVoxelTestWalls.h"

namespace
{
using namespace MedialVoxelTest;

using GrayImage = itk::Image<float, 3>;
using GrayFilter = itk::MedialSurfaceMeshFilter<GrayImage, MeshType>;

constexpr double Goal = 0.02; // mean distance to the true mid-surface, in voxels

/** Values of a part from 0 to 1. A voxel holds the mean over a Gaussian of its own size and that of the blur, as if the
 * surface were flat there. */
GrayImage::Pointer
GrayValues(const Part & part, double blur, const Vector3 & spacing = UnitSpacing)
{
  const double deviation = std::sqrt(blur * blur + 1.0 / 12);
  const auto   image = MakeImage<GrayImage>(MakeVolume(part.size, spacing, [](const Index3 &) { return false; }));
  itk::ImageRegionIteratorWithIndex<GrayImage> value(image, image->GetLargestPossibleRegion());
  for (; !value.IsAtEnd(); ++value)
  {
    const auto   index = value.GetIndex();
    const double depth = part.surface(PositionIn(part, { { double(index[0]), double(index[1]), double(index[2]) } }));
    value.Set(static_cast<float>(0.5 * std::erfc(depth / (deviation * std::sqrt(2.0)))));
  }
  return image;
}

GrayFilter::Pointer
MakeGrayFilter(GrayImage * image, double tau)
{
  auto filter = GrayFilter::New();
  filter->SetInput(image);
  filter->SetThickness(tau);
  filter->SetLowerThreshold(0.5);
  filter->SubvoxelThicknessOn();
  return filter;
}

/** Mean of the distances of the points for which a test holds. */
double
MeanDistance(const MeshType & mesh, const Part & part, const PointTest & counts)
{
  double      sum = 0.0;
  std::size_t number = 0;
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    const auto    point = mesh.GetPoint(i);
    const Vector3 position = PositionIn(part, { { point[0], point[1], point[2] } });
    if (counts(position))
    {
      sum += part.middle(position);
      ++number;
    }
  }
  return sum / static_cast<double>(number);
}

/** The smallest angle that all but one in a hundred triangles have, in degrees. */
double
AngleOfOneInHundred(const MeshType & mesh)
{
  std::vector<double> angles;
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfCells(); ++i)
  {
    MeshType::CellAutoPointer cell;
    EXPECT_TRUE(mesh.GetCell(i, cell));
    Vector3 corners[3];
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto point = mesh.GetPoint(cell->PointIdsBegin()[k]);
      corners[k] = { { point[0], point[1], point[2] } };
    }
    angles.push_back(SmallestAngle(corners[0], corners[1], corners[2]));
  }
  std::sort(angles.begin(), angles.end());
  return angles.at(angles.size() / 100);
}

bool
Everywhere(const Vector3 &)
{
  return true;
}

Part
PlatePart()
{
  return PartOfPlates("plate", 66, { { { { 0.0, 0.0, 0.0 } }, { { 22.0, 22.0, 2.0 } } } });
}
} // namespace

TEST(MedialVoxelSurfaceGray, CleanPartsAreMetWithinAFiftiethOfAVoxel)
{
  const std::pair<Part, double> parts[] = { { ShellPart(3), 3.0 }, { ShellPart(6), 3.0 }, { PlatePart(), 5.0 },
                                            { TeePart(), 5.0 },    { BendPart(), 5.0 },   { GyroidPart(), 3.0 } };
  for (const auto & [part, tau] : parts)
  {
    for (const double blur : { 0.5, 1.0 })
    {
      auto filter = MakeGrayFilter(GrayValues(part, blur), tau);
      filter->GenerateTrianglesOn();
      filter->Update();
      EXPECT_LE(MeanDistance(*filter->GetOutput(), part, Everywhere), Goal) << part.name << " blur " << blur;
      EXPECT_GE(AngleOfOneInHundred(*filter->GetOutput()), 26.0) << part.name << " blur " << blur;
      const auto points = filter->GetOutput()->GetNumberOfPoints();
      filter->SubvoxelThicknessOff();
      filter->Update();
      EXPECT_GT(MeanDistance(*filter->GetOutput(), part, Everywhere), 1.5 * Goal) << part.name << " blur " << blur;
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), points) << "the values move points and nothing else";
    }
  }
}

TEST(MedialVoxelSurfaceGray, TheJunctionOfAPlateAndARibIsTheirs)
{
  // Where the walls meet, the medial surface leaves their planes.
  const Part part = TeePart();
  auto       filter = MakeGrayFilter(GrayValues(part, 0.5), 5.0);
  filter->Update();
  const auto isAway = [](const Vector3 & position) {
    const Vector3 p = Turned(position);
    return std::hypot(p[0], p[2] + 12.0) > 4.0;
  };
  EXPECT_LE(MeanDistance(*filter->GetOutput(), part, isAway), 0.005);
}

TEST(MedialVoxelSurfaceGray, ThicknessIsThatOfTheGrayValues)
{
  auto filter = MakeGrayFilter(GrayValues(ShellPart(5), 0.5), 3.0);
  filter->Update();
  double     sum = 0.0;
  const auto points = filter->GetOutput()->GetNumberOfPoints();
  for (itk::IdentifierType i = 0; i < points; ++i)
  {
    float thickness = 0.0f;
    EXPECT_TRUE(filter->GetOutput()->GetPointData(i, &thickness));
    EXPECT_NEAR(thickness, 5.0, 0.5);
    sum += thickness;
  }
  EXPECT_NEAR(sum / static_cast<double>(points), 5.0, 0.06);
}

TEST(MedialVoxelSurfaceGray, AnyCutGivesTheSameMesh)
{
  const auto image = GrayValues(TeePart(), 0.7, { { 1.0, 1.1, 0.9 } });
  auto       filter = MakeGrayFilter(image, 3.0);
  filter->Update();
  const auto expected = NumbersOf(*filter->GetOutput());
  ASSERT_GT(expected.size(), 10000u);
  for (const unsigned int slices : { 1u, 7u, 100u })
  {
    filter->SetNumberOfSlicesPerPiece(slices);
    filter->SetNumberOfWorkUnits(slices == 7u ? 3 : 1);
    filter->SetWorkingMemoryLimit(slices == 7u ? 16000000 : 0);
    filter->Update();
    EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected)) << slices;
  }
}

TEST(MedialVoxelSurfaceGray, LengthsArePhysicalWhateverTheUnitsOfTheThreshold)
{
  const auto image = GrayValues(TeePart(), 0.7, { { 0.5, 0.5, 0.5 } });
  auto       physical = MakeGrayFilter(image, 1.5);
  auto       voxels = MakeGrayFilter(image, 3.0);
  voxels->UseImageSpacingOff();
  physical->Update();
  voxels->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*voxels->GetOutput()), NumbersOf(*physical->GetOutput())));
}

TEST(MedialVoxelSurfaceGray, ValuesThatTellNothingBreakNothing)
{
  // No gray between the materials, specks, and values that are not a number or infinite.
  auto         image = MakeImage<GrayImage>(RandomBoxes({ { 40, 30, 26 } }, UnitSpacing, 30, 98));
  std::mt19937 generator(11);
  itk::ImageRegionIteratorWithIndex<GrayImage> value(image, image->GetLargestPossibleRegion());
  for (; !value.IsAtEnd(); ++value)
  {
    const auto kind = generator() % 50;
    const auto infinity = std::numeric_limits<float>::infinity();
    value.Set(kind == 0 ? std::numeric_limits<float>::quiet_NaN()
                        : (kind == 1 ? infinity : (kind == 2 ? -infinity : value.Get())));
  }
  auto filter = MakeGrayFilter(image, 2.0);
  filter->Update();
  const auto numbers = NumbersOf(*filter->GetOutput());
  ASSERT_GT(numbers.size(), 5000u);
  EXPECT_TRUE(std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }));
}

TEST(MedialVoxelSurfaceGray, NeedsAThreshold)
{
  auto filter = MakeGrayFilter(GrayValues(PlatePart(), 0.5), 3.0);
  filter->UnsetThresholds();
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
}
