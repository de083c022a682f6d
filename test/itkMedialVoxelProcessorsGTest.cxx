// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// All versions of the kernels give the same bytes, by themselves and in whole filters.

#include "itkMedialVoxelProcessors.h"

#include "itkLocalThicknessImageFilter.h"
#include "itkMedialSurfaceMeshFilter.h"
#include "itkMedialVoxelColumnPass.h"
#include "itkMedialVoxelDistanceTransform.h"
#include "itkMedialVoxelFitSums.h"
#include "itkMedialVoxelGrayNormals.h"
#include "itkMedialVoxelLengthRow.h"
#include "itkMedialVoxelNontrivialEdges.h"
#include "itkMedialVoxelPairChoice.h"

#include "MedialVoxelTestGrayWalls.h"
#include "MedialVoxelTestMesh.h"
#include "MedialVoxelTestRuns.h"
#include "MedialVoxelTestVersions.h"

#include <cstdlib>
#include <functional>

namespace
{
using namespace MedialVoxelTest;
using Processors = itk::MedialVoxelProcessors;
using Version = Processors::Version;

/** Tests that force a version after the other. */
class MedialVoxelProcessors : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    if (!Processors::SetVersion(Version::Avx2))
    {
      GTEST_SKIP() << "this processor, or what this compiler builds, has one version of the kernels";
    }
  }

  void
  TearDown() override
  {
    Processors::SetVersion(m_First);
  }

  static Bytes
  Run(const Version version, const std::function<void(Bytes &)> & record)
  {
    EXPECT_TRUE(Processors::SetVersion(version));
    EXPECT_EQ(Processors::GetVersion(), version);
    return BytesOf(record);
  }

  static void
  ExpectSame(const std::function<void(Bytes &)> & record)
  {
    EXPECT_TRUE(AreSame(Run(Version::Avx2, record), Run(Version::Plain, record)));
  }

  const Version m_First{ Processors::GetVersion() };
};

/** Displacements of voxels, most of them near each other. */
std::vector<std::int32_t>
RandomDisplacements(const std::size_t number, std::mt19937 & random)
{
  std::vector<std::int32_t> values(number);
  const unsigned int        reach = 1 + random() % 20;
  std::generate(values.begin(), values.end(), [&] {
    return random() % 20 == 0 ? itk::MedialVoxelNoDisplacement
                              : static_cast<std::int32_t>(random() % (2 * reach + 1)) - static_cast<int>(reach);
  });
  return values;
}

void
RecordLengths(Bytes & bytes)
{
  constexpr std::int32_t none = itk::MedialVoxelSquaredLengths::None;
  std::mt19937           random(35);
  for (int trial = 0; trial < 600; ++trial)
  {
    // Floats are exact with a spacing of 1 and small squares.
    const itk::MedialVoxelLengthRow row(trial % 2 == 0 ? 1.0 : 0.957, trial % 5 == 0);
    const unsigned int              most = trial % 3 == 0 ? 20000000 : 3000;
    std::vector<std::int32_t>       squares(random() % 65);
    std::generate(squares.begin(), squares.end(), [&] {
      return random() % 30 == 0 ? none : static_cast<std::int32_t>(random() % most);
    });
    std::vector<float> lengths(squares.size());
    row.Write(squares.data(), static_cast<std::int64_t>(squares.size()), random(), lengths.data());
    bytes.Add(lengths);
  }
}

void
RecordCells(Bytes & bytes)
{
  std::mt19937 random(36);
  for (int trial = 0; trial < 600; ++trial)
  {
    const std::size_t                         cells = 1 + random() % 64;
    const std::vector<std::int32_t>           all = RandomDisplacements(12 * (cells + 1), random);
    itk::MedialVoxelCornerRows                corners;
    const std::array<const std::int32_t *, 3> lower{ { all.data(), all.data() + cells, all.data() + 2 * cells } };
    const std::array<const std::int32_t *, 3> upper{
      { lower[0] + 3 * cells, lower[1] + 3 * cells, lower[2] + 3 * cells }
    };
    for (std::size_t i = 0; i < 12; ++i)
    {
      corners.rows[i / 4][i % 4] = all.data() + i * (cells + 1);
    }
    const std::uint64_t         asked = (std::uint64_t{ random() } << 32) | random();
    const auto                  number = static_cast<std::int64_t>(cells);
    std::array<std::int8_t, 64> widest{};
    itk::MedialVoxelWidestDiagonals(corners, asked, number, widest.data());
    bytes.Add(widest.data(), cells);
    const std::uint64_t nontrivial[2] = { itk::MedialVoxelNontrivialCells(corners, asked, number),
                                          itk::MedialVoxelNontrivialEdges(
                                            lower, upper, static_cast<unsigned int>(trial) % 3, asked, number) };
    bytes.Add(nontrivial, 2);
  }
}

template <typename TImage>
void
AddPixels(const TImage * image, Bytes & bytes)
{
  bytes.Add(PixelsOf(image));
}

/** Labels, vectors, distances and thickness of a mask. */
void
RecordMask(const Volume & volume, const bool isAutomatic, Bytes & bytes)
{
  auto medial = MakeMedialFilter<3>(volume, 3.0);
  medial->SetThicknessMode(isAutomatic ? itk::MedialVoxelThicknessMode::Automatic
                                       : itk::MedialVoxelThicknessMode::Fixed);
  medial->GenerateThicknessOn();
  medial->GenerateVectorDistanceOn();
  medial->Update();
  AddPixels(medial->GetOutput(), bytes);
  AddPixels(medial->GetThicknessOutput(), bytes);
  AddPixels(medial->GetVectorDistanceOutput(), bytes);
  auto vectors = VectorFilter<3>::New();
  vectors->SetInput(MakeImage<MaskImage<3>>(volume));
  vectors->GenerateDistanceOn();
  vectors->Update();
  AddPixels(vectors->GetOutput(), bytes);
  AddPixels(vectors->GetDistanceOutput(), bytes);
}
} // namespace

TEST_F(MedialVoxelProcessors, TheBestRunsAtFirstUnlessTheEnvironmentForbidsIt)
{
  EXPECT_EQ(m_First, std::getenv("MEDIALVOXEL_NO_AVX2") != nullptr ? Version::Plain : Version::Avx2);
}

#if defined(MEDIALVOXEL_HAS_VERSIONS)
namespace
{
/** Where it is itself. */
MEDIALVOXEL_INLINE const void *
GetPlace(const int)
{
  const void * place;
  __asm__ volatile("lea 0(%%rip), %0" : "=r"(place));
  return place;
}
} // namespace

TEST_F(MedialVoxelProcessors, EachVersionHasItsOwnCode)
{
  const auto run = [](const Version version) {
    EXPECT_TRUE(Processors::SetVersion(version));
    return itk::MedialVoxelKernel<GetPlace>::Run(0);
  };
  const void * const plain = run(Version::Plain);
  const void * const avx2 = run(Version::Avx2);
  EXPECT_NE(plain, avx2);
  EXPECT_EQ(run(Version::Plain), plain);
}
#endif

TEST_F(MedialVoxelProcessors, FitsAndNormalsHaveTheSameBytes)
{
  ExpectSame(RecordFits<itk::MedialVoxelFitSums>);
  ExpectSame(RecordNormals<itk::MedialVoxelGrayNormals>);
}

TEST_F(MedialVoxelProcessors, DistancesHaveTheSameBytes)
{
  ExpectSame(RecordColumns<itk::MedialVoxelColumnPass>);
  ExpectSame(RecordRows<itk::MedialVoxelRowPass>);
  ExpectSame(RecordDistances<itk::MedialVoxelDistanceTransform>);
  ExpectSame(RecordLengths);
}

TEST_F(MedialVoxelProcessors, CellsAndEdgesHaveTheSameBytes)
{
  ExpectSame(RecordCells);
}

TEST_F(MedialVoxelProcessors, FiltersOfMasksHaveTheSameBytes)
{
  for (unsigned int seed = 1; seed <= 3; ++seed)
  {
    for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 0.957, 0.957, 1.5 } } })
    {
      const Volume volume = RandomBoxes({ { 70, 41, 37 } }, spacing, 25, seed);
      ExpectSame([&](Bytes & bytes) { RecordMask(volume, seed == 2, bytes); });
    }
  }
}

TEST_F(MedialVoxelProcessors, FiltersOfGrayValuesHaveTheSameBytes)
{
  const auto image = BlurredWall({ { 64, 60, 56 } }, UnitSpacing, 6.0, 0.7, ToSphere({ { 31, 29, 27 } }, 21.0));
  ExpectSame([&](Bytes & bytes) {
    const auto sheet = MakeGrayFilter(image, 10.0);
    sheet->Update();
    EXPECT_TRUE(sheet->GetScan().scan.has_value()) << sheet->GetScan().reason;
    AddPixels(sheet->GetThicknessOutput(), bytes);
    auto mesh = itk::MedialSurfaceMeshFilter<GrayImage, MeshType>::New();
    mesh->SetInput(image);
    mesh->SetThickness(10.0);
    mesh->SetLowerThreshold(MiddleValue);
    mesh->SubvoxelThicknessOn();
    mesh->Update();
    bytes.Add(NumbersOf(*mesh->GetOutput()));
    auto local = itk::LocalThicknessImageFilter<GrayImage>::New();
    local->SetInput(image);
    local->SetLowerThreshold(MiddleValue);
    local->SetLargestBall(14.0);
    local->SubvoxelThicknessOn();
    local->Update();
    AddPixels(local->GetOutput(), bytes);
  });
}
