// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialSurfaceMeshFilter.h"

#include "MedialVoxelTestMesh.h"
#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestSurface.h"

#include "itkCommand.h"

#include <sstream>

namespace
{
using namespace MedialVoxelTest;
template <typename TPixel>
using MeshFilter = itk::MedialSurfaceMeshFilter<itk::Image<TPixel, 3>, MeshType>;
using MaskMeshFilter = MeshFilter<unsigned char>;

Volume
TestVolume()
{
  return RandomBoxes({ { 40, 25, 31 } }, { { 1.0, 1.2, 0.8 } }, 25, 641);
}

MaskMeshFilter::Pointer
MakeFilter(const Volume & volume, double thickness)
{
  auto filter = MaskMeshFilter::New();
  filter->SetInput(MakeImage<MaskImage<3>>(volume));
  filter->SetThickness(thickness);
  return filter;
}

/** The numbers of the mesh that a surface of the kernels becomes. */
std::vector<double>
NumbersOf(const Surface & surface)
{
  std::vector<double> numbers;
  for (const auto & vertex : surface.vertices)
  {
    for (const double number : { vertex.point[0], vertex.point[1], vertex.point[2], vertex.thickness })
    {
      numbers.push_back(static_cast<float>(number));
    }
  }
  for (const auto & quad : surface.quads)
  {
    numbers.insert(numbers.end(), quad.vertices.begin(), quad.vertices.end());
    numbers.push_back(static_cast<float>(quad.GetArea()));
  }
  return numbers;
}

/** Aborts a filter at its first progress. */
class Aborter : public itk::Command
{
public:
  using Self = Aborter;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  void
  Execute(itk::Object * caller, const itk::EventObject &) override
  {
    dynamic_cast<itk::ProcessObject &>(*caller).AbortGenerateDataOn();
  }
  void
  Execute(const itk::Object *, const itk::EventObject &) override
  {}
};
} // namespace

TEST(MedialSurfaceMeshFilter, GivesTheSurfaceOfTheKernels)
{
  const Volume volume = TestVolume();
  const auto   filter = MakeFilter(volume, 3.0);
  filter->Update();
  const auto expected = NumbersOf(MakeSurface(volume, 3.0));
  ASSERT_GT(expected.size(), 5000u);
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected));
}

TEST(MedialSurfaceMeshFilter, PiecesThreadsAndMemoryHaveNoInfluence)
{
  const Volume volume = TestVolume();
  const auto   filter = MakeFilter(volume, 3.0);
  filter->Update();
  const auto expected = NumbersOf(*filter->GetOutput());
  for (const unsigned int slices : { 1u, 2u, 7u, 30u, 31u, 100u })
  {
    for (const unsigned int threads : { 1u, 3u })
    {
      filter->SetNumberOfSlicesPerPiece(slices);
      filter->SetNumberOfWorkUnits(threads);
      filter->SetWorkingMemoryLimit(slices == 7u ? 16000000 : 0);
      filter->Update();
      EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected)) << slices << ' ' << threads;
    }
  }
}

TEST(MedialSurfaceMeshFilter, AutomaticThicknessIsThatOfTheKernels)
{
  const Volume volume = TestVolume();
  const auto   filter = MakeFilter(volume, 3.0);
  filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  filter->SetMinimumThickness(2.0);
  filter->SetMaximumThickness(11.0);
  filter->Update();
  const auto parameters =
    itk::MedialVoxelParameters::ForWalls(2.0, 11.0, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
  const auto expected = NumbersOf(MakeSurface(volume, parameters));
  ASSERT_GT(expected.size(), 1000u);
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected));
  filter->SetNumberOfSlicesPerPiece(4);
  filter->SetNumberOfWorkUnits(3);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected));
}

TEST(MedialSurfaceMeshFilter, PullsTheInputPieceByPiece)
{
  const Volume volume = RandomBoxes({ { 30, 24, 140 } }, UnitSpacing, 60, 651);
  auto         source = RecordingSource<MaskImage<3>>::New();
  source->SetImage(MakeImage<MaskImage<3>>(volume));
  auto filter = MaskMeshFilter::New();
  filter->SetInput(source->GetOutput());
  filter->SetNumberOfSlicesPerPiece(10);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), NumbersOf(MakeSurface(volume, 3.0))));
  EXPECT_LT(source->GetLargestRequest(), volume.object.size() / 2);
  EXPECT_TRUE(source->WasAskedByOneThread());
}

TEST(MedialSurfaceMeshFilter, ChangesOfPropertiesMakeANewMesh)
{
  const Volume volume = TestVolume();
  const auto   filter = MakeFilter(volume, 3.0);
  filter->Update();
  const auto before = NumbersOf(*filter->GetOutput());
  filter->SetThickness(6.0);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), NumbersOf(MakeSurface(volume, 6.0))));
  filter->SetThickness(3.0);
  filter->GenerateTrianglesOn();
  filter->Update();
  const auto numberOfTriangles = filter->GetOutput()->GetNumberOfCells();
  filter->GenerateTrianglesOff();
  filter->Update();
  EXPECT_EQ(numberOfTriangles, 2 * filter->GetOutput()->GetNumberOfCells());
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), before));
}

TEST(MedialSurfaceMeshFilter, SplitsQuadrilateralsAlongTheShorterDiagonal)
{
  const Volume  volume = TestVolume();
  const Surface surface = MakeSurface(volume, 3.0);
  const auto    filter = MakeFilter(volume, 3.0);
  filter->GenerateTrianglesOn();
  filter->Update();
  const MeshType & mesh = *filter->GetOutput();
  ASSERT_EQ(mesh.GetNumberOfCells(), 2 * surface.quads.size());
  for (std::size_t i = 0; i < surface.quads.size(); ++i)
  {
    for (std::size_t half = 0; half < 2; ++half)
    {
      MeshType::CellAutoPointer cell;
      float                     area = 0.0f;
      ASSERT_TRUE(mesh.GetCell(2 * i + half, cell));
      ASSERT_TRUE(mesh.GetCellData(2 * i + half, &area));
      ASSERT_EQ(cell->GetNumberOfPoints(), 3u);
      const auto expected = TrianglesOf(surface.quads[i])[half];
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), cell->PointIdsBegin()));
      EXPECT_EQ(area, static_cast<float>(surface.quads[i].areas[half]));
    }
  }
}

TEST(MedialSurfaceMeshFilter, MarksSidesOfRimsAndJunctions)
{
  const Volume  volume = TestVolume();
  const Surface surface = MakeSurface(volume, 3.0);
  const auto    sides = CountSides(surface);
  const auto    filter = MakeFilter(volume, 3.0);
  filter->MarkSidesOn();
  for (const bool triangles : { false, true })
  {
    filter->SetGenerateTriangles(triangles);
    filter->Update();
    const MeshType & mesh = *filter->GetOutput();
    int              marked = 0;
    for (itk::IdentifierType i = 0; i < mesh.GetNumberOfCells(); ++i)
    {
      MeshType::CellAutoPointer cell;
      float                     marks = 0.0f;
      ASSERT_TRUE(mesh.GetCell(i, cell));
      ASSERT_TRUE(mesh.GetCellData(i, &marks));
      const std::vector<std::uint64_t> points(cell->PointIdsBegin(), cell->PointIdsEnd());
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        const auto side = sides.find(std::minmax(points[k], points[(k + 1) % points.size()]));
        const int  number = side == sides.end() ? 2 : side->second;
        const int  expected = (number == 1 ? 1 : 0) + (number > 2 ? 16 : 0);
        EXPECT_EQ(static_cast<int>(marks) >> k & 17, expected);
        marked += expected;
      }
    }
    EXPECT_GT(marked, 1000);
  }
}

TEST(MedialSurfaceMeshFilter, PointsArePhysical)
{
  const Volume                volume = TestVolume();
  const auto                  image = MakeImage<MaskImage<3>>(volume, -3);
  MaskImage<3>::DirectionType direction;
  const double                c = 0.8;
  const double                s = 0.6;
  direction(0, 0) = c;
  direction(0, 1) = 0.0;
  direction(0, 2) = s;
  direction(1, 0) = s;
  direction(1, 1) = 0.0;
  direction(1, 2) = -c;
  direction(2, 0) = 0.0;
  direction(2, 1) = 1.0;
  direction(2, 2) = 0.0;
  image->SetDirection(direction);
  const double origin[] = { 7.0, -8.0, 9.0 };
  image->SetOrigin(origin);
  auto filter = MaskMeshFilter::New();
  filter->SetInput(image);
  filter->Update();
  const MeshType & mesh = *filter->GetOutput();
  const Surface    plain = MakeSurface(volume, 3.0);
  ASSERT_EQ(mesh.GetNumberOfPoints(), plain.vertices.size());
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    itk::ContinuousIndex<double, 3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = plain.vertices[i].point[axis] / volume.spacing[axis] - 3.0;
    }
    MaskImage<3>::PointType expected;
    image->TransformContinuousIndexToPhysicalPoint(index, expected);
    EXPECT_LT(expected.EuclideanDistanceTo(MaskImage<3>::PointType(mesh.GetPoint(i))), 1e-4);
  }
}

TEST(MedialSurfaceMeshFilter, CoordinatesThatNeed64BitsAreNotRounded)
{
  const auto              image = MakeImage<MaskImage<3>>(TestVolume());
  const auto              spacing = image->GetSpacing();
  const double            away = 2e7;
  MaskImage<3>::PointType origin;
  origin.Fill(away);
  image->SetOrigin(origin);
  auto rounded = MaskMeshFilter::New();
  rounded->SetInput(image);
  try
  {
    rounded->Update();
    FAIL() << "points fall together";
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find("2e+07"), std::string::npos) << error;
  }
  using Traits = itk::DefaultStaticMeshTraits<float, 3, 3, double>;
  using DoubleMesh = itk::Mesh<float, 3, Traits>;
  auto exact = itk::MedialSurfaceMeshFilter<MaskImage<3>, DoubleMesh>::New();
  exact->SetInput(image);
  exact->Update();
  const Surface expected = MakeSurface(TestVolume(), 3.0);
  ASSERT_EQ(exact->GetOutput()->GetNumberOfPoints(), expected.vertices.size());
  for (std::size_t i = 0; i < expected.vertices.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(exact->GetOutput()->GetPoint(i)[axis] - away, expected.vertices[i].point[axis], 1e-7);
    }
  }
  // As far as 32 bits do.
  origin.Fill(0.001 * spacing[2] * 16777216.0 - 100.0);
  image->SetOrigin(origin);
  EXPECT_NO_THROW(rounded->Update());
  EXPECT_EQ(rounded->GetOutput()->GetNumberOfPoints(), expected.vertices.size());
  origin.Fill(0.001 * spacing[2] * 16777216.0);
  image->SetOrigin(origin);
  EXPECT_THROW(rounded->Update(), itk::ExceptionObject);
}

TEST(MedialSurfaceMeshFilter, ThicknessInVoxelsStillGivesPhysicalPoints)
{
  Volume volume = TestVolume();
  volume.spacing = { { 0.25, 0.25, 0.25 } };
  const auto voxels = MakeFilter(volume, 3.0);
  voxels->UseImageSpacingOff();
  voxels->Update();
  const auto physical = MakeFilter(volume, 0.75);
  physical->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*voxels->GetOutput()), NumbersOf(*physical->GetOutput())));
}

TEST(MedialSurfaceMeshFilter, ObjectIsThatOfTheLabels)
{
  const Volume volume = TestVolume();
  auto         filter = MeshFilter<short>::New();
  filter->SetInput(MakeImage<itk::Image<short, 3>>(volume, 0, 800, -100));
  filter->SetLowerThreshold(350.5);
  filter->Update();
  const auto expected = NumbersOf(MakeSurface(volume, 3.0));
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected));
  filter->UnsetThresholds();
  filter->SetBackgroundValue(-100);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected));
  filter->SetObjectValue(800);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected));
}

TEST(MedialSurfaceMeshFilter, VolumesWithoutSurfaceGiveAnEmptyMesh)
{
  for (const Volume & volume : { Volume({ { 9, 8, 7 } }, UnitSpacing),
                                 AxisPlate({ { 20, 20, 1 } }, UnitSpacing, 0, 6, 5),
                                 MakeVolume({ { 1, 1, 1 } }, UnitSpacing, [](const Index3 &) { return true; }) })
  {
    const auto filter = MakeFilter(volume, 3.0);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0u);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0u);
  }
}

TEST(MedialSurfaceMeshFilter, RefusesWhatTheLabelFilterRefuses)
{
  const auto filter = MakeFilter(TestVolume(), 0.0);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->SetThickness(3.0);
  filter->SetLowerThreshold(2.0);
  filter->SetUpperThreshold(1.0);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->UnsetThresholds();
  EXPECT_NO_THROW(filter->Update());
  EXPECT_THROW(MaskMeshFilter::New()->Update(), itk::ExceptionObject);
}

TEST(MedialSurfaceMeshFilter, AnAbortLeavesItUsable)
{
  const Volume volume = TestVolume();
  const auto   filter = MakeFilter(volume, 3.0);
  filter->SetNumberOfSlicesPerPiece(3);
  const auto tag = filter->AddObserver(itk::ProgressEvent(), Aborter::New());
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0u);
  filter->RemoveObserver(tag);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), NumbersOf(MakeSurface(volume, 3.0))));
}

TEST(MedialSurfaceMeshFilter, LeavesOutSmallComponents)
{
  const auto plates = [](bool withSmallOne) {
    return MakeVolume({ { 30, 24, 20 } }, UnitSpacing, [=](const Index3 & v) {
      const bool isLarge = v[0] < 18 && v[2] >= 4 && v[2] < 7;
      const bool isSmall = v[0] >= 22 && v[1] < 10 && v[2] >= 10 && v[2] < 13;
      return isLarge || (withSmallOne && isSmall);
    });
  };
  const auto filter = MakeFilter(plates(true), 3.0);
  filter->Update();
  const auto all = NumbersOf(*filter->GetOutput());
  const auto alone = MakeFilter(plates(false), 3.0);
  alone->Update();
  const auto expected = NumbersOf(*alone->GetOutput());
  const auto size = alone->GetOutput()->GetNumberOfCells();
  ASSERT_GT(all.size(), expected.size());
  filter->SetSmallestComponent(size);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), expected));
  filter->SetSmallestComponent(size + 1);
  filter->Update();
  EXPECT_TRUE(NumbersOf(*filter->GetOutput()).empty());
  filter->SetSmallestComponent(1);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), all));
}

TEST(MedialSurfaceMeshFilter, LeavesOutShortBranches)
{
  // A rib on a plate, both of three voxels; their sheets begin one and a half voxels from their ends.
  const auto part = [](int height) {
    return MakeVolume({ { 40, 30, 24 } }, { { 0.5, 0.5, 0.5 } }, [=](const Index3 & v) {
      const bool inPlate = v[0] >= 4 && v[0] < 36 && v[2] >= 4 && v[2] < 7;
      const bool inRib = v[0] >= 18 && v[0] < 21 && v[2] >= 7 && v[2] < 7 + height;
      return v[1] >= 4 && v[1] < 26 && (inPlate || inRib);
    });
  };
  const auto filter = MakeFilter(part(10), 1.5);
  filter->Update();
  const auto all = NumbersOf(*filter->GetOutput());
  const auto faces = filter->GetOutput()->GetNumberOfCells();
  filter->SetMinimumBranchLength(3.0);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), all)) << "the rib is longer";
  filter->SetMinimumBranchLength(6.5);
  filter->MarkSidesOn();
  filter->Update();
  const auto cut = NumbersOf(*filter->GetOutput());
  EXPECT_LT(filter->GetOutput()->GetNumberOfCells(), faces - 100);
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 400u);
  for (itk::IdentifierType i = 0; i < filter->GetOutput()->GetNumberOfCells(); ++i)
  {
    float marks = 0.0f;
    EXPECT_TRUE(filter->GetOutput()->GetCellData(i, &marks));
    EXPECT_LT(marks, 16.0f) << "a junction of nothing";
  }
  filter->SetNumberOfSlicesPerPiece(3);
  filter->SetNumberOfWorkUnits(3);
  filter->Update();
  EXPECT_TRUE(AreEqual(NumbersOf(*filter->GetOutput()), cut));
  for (const double length : { -1.0, std::numeric_limits<double>::infinity() })
  {
    filter->SetMinimumBranchLength(length);
    EXPECT_THROW(filter->Update(), itk::ExceptionObject) << length;
  }
}

TEST(MedialSurfaceMeshFilter, LabelsHaveItsProperties)
{
  const auto filter = MakeFilter(TestVolume(), 4.5);
  filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  filter->SetMinimumThickness(2.5);
  filter->SetMaximumThickness(7.5);
  filter->SetMaximumPoreSize(9);
  filter->SetSmoothing(itk::MedialVoxelSmoothing::On);
  filter->SetPseudoGeodesicBound(itk::MedialVoxelPseudoGeodesicBound::Off);
  filter->SetBackgroundValue(6);
  filter->SetObjectValue(1);
  filter->SetLowerThreshold(0.5);
  filter->SetUpperThreshold(7.5);
  filter->SubvoxelThicknessOn();
  filter->SetScanLevels(-1.0, 2.0);
  filter->UseImageSpacingOff();
  filter->SetWorkingMemoryLimit(123456789);
  filter->Update();
  std::ostringstream text;
  filter->Print(text);
  for (const std::string line : { "Thickness: 4.5",
                                  "MinimumThickness: 2.5",
                                  "MaximumThickness: 7.5",
                                  "MaximumPoreSize: 9",
                                  "BackgroundValue: 6",
                                  "ObjectValue: 1",
                                  "UseObjectValue: Off",
                                  "UseThresholds: On",
                                  "LowerThreshold: 0.5",
                                  "UpperThreshold: 7.5",
                                  "SubvoxelThickness: On",
                                  "ScanLevels: -1 2",
                                  "UseImageSpacing: Off",
                                  "WorkingMemoryLimit: 123456789" })
  {
    const auto own = text.str().find(' ' + line + '\n');
    ASSERT_NE(own, std::string::npos) << line;
    EXPECT_NE(text.str().find(' ' + line + '\n', own + 1), std::string::npos) << line;
  }
  EXPECT_TRUE(filter->GetObjectIsSmoothed());
  EXPECT_FALSE(filter->GetScan().reason.empty());
}

TEST(MedialSurfaceMeshFilter, PrintsItsProperties)
{
  const auto filter = MaskMeshFilter::New();
  EXPECT_EQ(filter->GetThickness(), 3.0);
  EXPECT_TRUE(filter->GetUseImageSpacing());
  EXPECT_EQ(filter->GetWorkingMemoryLimit(), 0u);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("GenerateTriangles: Off"), std::string::npos);
  EXPECT_NE(text.str().find("Thickness: 3"), std::string::npos);
}
