// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Real CT volumes: crops against brute force, whole volumes against ITK's distance maps.

#include "MedialVoxelTestLocalThickness.h"
#include "MedialVoxelTestMaurer.h"
#include "MedialVoxelTestMesh.h"
#include "MedialVoxelTestWallThickness.h"

#include "itkMedialSurfaceMeshFilter.h"

namespace
{
using namespace MedialVoxelTest;

struct RealVolume
{
  const char * fileName;
  double       threshold;
};

const RealVolume Engine{ "engine.mha", 72 };
const RealVolume Cranium{ "cranium.mha", 200 };
const RealVolume Shell{ "shell.nrrd", 65 };

Volume
Load(const std::string & path, const RealVolume & real)
{
  return VolumeOf(ReadImage<itk::Image<short, 3>>(path).GetPointer(), real.threshold);
}

/** Crops of this size that hold between a tenth and nine tenths of object, spread over the volume. */
std::vector<Volume>
InterestingCrops(const Volume & volume, const Index3 & size, std::size_t count, unsigned int seed)
{
  std::mt19937        generator(seed);
  std::vector<Volume> crops;
  while (crops.size() < count)
  {
    Index3 low;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = static_cast<int>(generator() % (volume.size[axis] - size[axis] + 1));
    }
    const Volume crop = Cropped(volume, low, size);
    const double share =
      static_cast<double>(std::count(crop.object.begin(), crop.object.end(), 1)) / crop.object.size();
    if (share > 0.1 && share < 0.9)
    {
      crops.push_back(crop);
    }
  }
  return crops;
}

void
ExpectCropsAreBruteForce(const Volume & whole)
{
  for (const Volume & crop : InterestingCrops(whole, { { 20, 19, 18 } }, 2, 5))
  {
    for (const Volume & volume : { crop, InVoxelUnits(crop) })
    {
      for (const double thickness : { 2.0, 3.0, 5.0, 8.0 })
      {
        Classifier oracle(volume, thickness);
        for (const Bound bound : { Bound::FreeSpace, Bound::Off })
        {
          const auto expected = oracle.Run(bound);
          const auto actual = RunMedialFilter<3>(volume, thickness, bound);
          EXPECT_TRUE(AreEqual(actual.labels, expected.labels)) << "thickness " << thickness;
          EXPECT_EQ(actual.counts, expected.counts);
        }
      }
      for (const BoundarySide side : { BoundarySide::Object, BoundarySide::Background })
      {
        auto filter = VectorFilter<3>::New();
        filter->SetInput(MakeImage<MaskImage<3>>(volume));
        filter->SetBoundary(side == BoundarySide::Object ? itk::MedialVoxelBoundary::Object
                                                         : itk::MedialVoxelBoundary::Background);
        filter->Update();
        const std::vector<unsigned char> everywhere(volume.object.size(), 1);
        EXPECT_TRUE(VectorsAreEqual(PixelsOf(filter->GetOutput()),
                                    ExpectedVectors<3>(volume, BoundarySites(volume, side), everywhere)));
      }
    }
  }
}

void
ExpectLocalThicknessIsBruteForce(const Volume & whole)
{
  for (const Volume & crop : InterestingCrops(whole, { { 34, 30, 28 } }, 3, 8))
  {
    for (const double maximum : { 9.0, 32.0 })
    {
      auto filter = ThicknessFilter<3>::New();
      filter->SetInput(MakeImage<MaskImage<3>>(crop));
      filter->SetLargestBall(maximum);
      filter->SetMethod(itk::MedialVoxelLocalThicknessMethod::Sphere);
      filter->Update();
      EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), ExpectedThickness(crop, maximum))) << maximum;
      filter->SetMethod(itk::MedialVoxelLocalThicknessMethod::Wall);
      filter->Update();
      EXPECT_TRUE(AreEqualOrNan(PixelsOf(filter->GetOutput()), ExpectedWallThickness<3>(crop, maximum))) << maximum;
    }
  }
}

/** Thresholds inside the filter, on the original pixel values, give what the mask gives. */
template <typename TPixel>
void
ExpectThresholdIsTheMask(const std::string & path, const RealVolume & real)
{
  const auto image = ReadImage<itk::Image<TPixel, 3>>(path);
  auto       filter = itk::MedialVoxelImageFilter<itk::Image<TPixel, 3>>::New();
  filter->SetInput(image);
  filter->SetLowerThreshold(real.threshold - 0.5);
  filter->SetThickness(3.0);
  filter->Update();
  const auto masked = RunMedialFilter<3>(VolumeOf(image.GetPointer(), real.threshold), 3.0);
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), masked.labels));
  EXPECT_EQ(CountsOf(filter.GetPointer()), masked.counts);
  EXPECT_GT(masked.counts.boundCells + masked.counts.geodesicMedialCells, 1000u);
}
} // namespace

TEST(MedialVoxelRealData, CropsOfTheEngineAreBruteForce)
{
  const auto path = RealDataPath(Engine.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Engine.fileName);
  ExpectCropsAreBruteForce(Load(path, Engine));
}

TEST(MedialVoxelRealData, CropsOfTheCraniumAreBruteForce)
{
  const auto path = RealDataPath(Cranium.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Cranium.fileName);
  ExpectCropsAreBruteForce(Load(path, Cranium));
}

TEST(MedialVoxelRealData, CropsOfTheShellAreBruteForce)
{
  const auto path = RealDataPath(Shell.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Shell.fileName);
  ExpectCropsAreBruteForce(Load(path, Shell));
}

TEST(MedialVoxelRealData, LocalThicknessOfCropsIsBruteForce)
{
  for (const RealVolume & real : { Engine, Cranium, Shell })
  {
    const auto path = RealDataPath(real.fileName);
    MEDIALVOXEL_SKIP_WITHOUT(path, real.fileName);
    ExpectLocalThicknessIsBruteForce(Load(path, real));
  }
}

TEST(MedialVoxelRealData, ThresholdOfTheEngineIsTheMask)
{
  const auto path = RealDataPath(Engine.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Engine.fileName);
  ExpectThresholdIsTheMask<unsigned char>(path, Engine);
  EXPECT_EQ(RunMedialFilter<3>(Load(path, Engine), 3.0).counts.objectVoxels, 1156699u);
}

TEST(MedialVoxelRealData, ThresholdOfTheCraniumIsTheMask)
{
  const auto path = RealDataPath(Cranium.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Cranium.fileName);
  ExpectThresholdIsTheMask<short>(path, Cranium);
}

TEST(MedialVoxelRealData, EngineDistancesAreSignedMaurer)
{
  const auto path = RealDataPath(Engine.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Engine.fileName);
  const Volume volume = Load(path, Engine);
  ExpectObjectBorderIsMaurer<3>(volume);
  ExpectBackgroundBorderIsMaurerOfTheComplement<3>(volume);
}

TEST(MedialVoxelRealData, CraniumDistancesAreSignedMaurer)
{
  const auto path = RealDataPath(Cranium.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Cranium.fileName);
  const Volume volume = Load(path, Cranium);
  ExpectObjectBorderIsMaurer<3>(volume);
  ExpectBackgroundBorderIsMaurerOfTheComplement<3>(volume);
}

TEST(MedialVoxelRealData, ShellDistancesAreSignedMaurer)
{
  const auto path = RealDataPath(Shell.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Shell.fileName);
  const Volume volume = Load(path, Shell);
  ExpectObjectBorderIsMaurer<3>(volume);
  ExpectBackgroundBorderIsMaurerOfTheComplement<3>(volume);
}

TEST(MedialVoxelRealData, BoundsDoNotChangeTheMedialCellsOfTheShell)
{
  const auto path = RealDataPath(Shell.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Shell.fileName);
  const Volume volume = Load(path, Shell);
  const auto   bounded = RunMedialFilter<3>(volume, 3.0, Bound::FreeSpace).labels;
  const auto   plain = RunMedialFilter<3>(volume, 3.0, Bound::Off).labels;
  std::size_t  differences = 0;
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    differences += (plain[i] >= 2) != (bounded[i] >= 2) ? 1 : 0;
  }
  EXPECT_EQ(differences, 0u);
}

TEST(MedialVoxelRealData, AutomaticMeshOfThickTissue)
{
  const auto path = RealDataPath(Cranium.fileName);
  MEDIALVOXEL_SKIP_WITHOUT(path, Cranium.fileName);
  // Boundary points of which one is farther from the other than the threshold meet at sheets that touch.
  const Volume tissue = Cropped(Load(path, { Cranium.fileName, -200 }), { { 60, 0, 60 } }, { { 125, 130, 48 } });
  auto         filter = itk::MedialSurfaceMeshFilter<MaskImage<3>, MeshType>::New();
  filter->SetInput(MakeImage<MaskImage<3>>(tissue));
  filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  EXPECT_NO_THROW(filter->Update());
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 1000u);
}
