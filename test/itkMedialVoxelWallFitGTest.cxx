// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Fits of blurred walls to noisy values, against the walls that the values were made of.

#include "itkMedialVoxelGrayNormals.h"
#include "itkMedialVoxelNormalDistribution.h"
#include "itkMedialVoxelRandomSample.h"
#include "itkMedialVoxelScanSurvey.h"
#include "itkMedialVoxelWallFit.h"

#include "gtest/gtest.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace
{
using Vector3 = itk::MedialVoxelVector3;
using Index3 = itk::MedialVoxelIndex;
using Share = std::function<double(double)>; // of material at a distance

constexpr double Background = 1000.0;
constexpr double Material = 3000.0;

double
Cumulative(const double x)
{
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

/** Material at a distance from the middle of a wall. */
Share
MakeWall(const double thickness, const double blur, const double middle = 0.0)
{
  return [=](const double s) {
    return Cumulative((s - middle + 0.5 * thickness) / blur) - Cumulative((s - middle - 0.5 * thickness) / blur);
  };
}

Vector3
Unit(const Vector3 & v)
{
  const double length = itk::MedialVoxelNorm(v);
  return { { v[0] / length, v[1] / length, v[2] / length } };
}

struct Volume
{
  Volume(const Index3 & size, const Vector3 & direction, const double place, const Share & share, const double noise)
    : grid(size, { { 1.0, 1.0, 1.0 } })
    , normal(Unit(direction))
    , offset(place)
  {
    std::mt19937_64            random(42);
    std::normal_distribution<> normalDistribution;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      offset += 0.5 * normal[axis] * static_cast<double>(size[axis] - 1);
    }
    gray.Frame(grid.GetVoxelBox(), grid.GetVoxelBox());
    object.Reshape(grid.GetVoxelBox());
    for (std::int64_t z = 0; z < size[2]; ++z)
    {
      for (std::int64_t y = 0; y < size[1]; ++y)
      {
        for (std::int64_t x = 0; x < size[0]; ++x)
        {
          const double s = this->DistanceTo({ { double(x), double(y), double(z) } });
          const double value = share(s) + noise * normalDistribution(random);
          gray.GetRow(y, z)[x] = static_cast<float>(Background + (Material - Background) * value);
          if (share(s) >= 0.5)
          {
            object.Set({ { x, y, z } });
          }
        }
      }
    }
  }

  double
  DistanceTo(const Vector3 & place) const
  {
    return itk::MedialVoxelDot(place, normal) - offset;
  }

  itk::MedialVoxelGrid grid;
  itk::MedialVoxelGray gray;
  itk::MedialVoxelBits object;
  Vector3              normal;
  double               offset;
};

struct Errors
{
  double      bias{ 0.0 };
  double      rms{ 0.0 };
  double      coverage{ 0.0 }; // of intervals from the noise alone
  std::size_t cells{ 0 };
  std::size_t unresolved{ 0 };
};

/** Of the cells next to the middle of the wall, farther than 13 voxels from the faces of the image. */
Errors
MeasureErrors(const Volume & volume, const double thickness, const itk::MedialVoxelScan & scan)
{
  const itk::MedialVoxelGrayLocal    local(volume.grid, scan.background, scan.material);
  itk::MedialVoxelGrayNormals        normals(volume.grid, scan.background, scan.material);
  const itk::MedialVoxelWallFit      fit(scan, volume.grid.GetNumberOfActiveAxes());
  itk::MedialVoxelGrayLocal::Samples samples;
  Errors                             errors;
  std::size_t                        missing = 0;
  double                             extent = 0.0;
  Index3                             margin{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    extent += 0.5 * std::abs(volume.normal[axis]);
    margin[axis] = volume.grid.IsActive(axis) ? 13 : 0;
  }
  const itk::MedialVoxelBox inner = volume.grid.GetVoxelBox().Expanded({ { -margin[0], -margin[1], -margin[2] } });
  for (std::int64_t z = inner.lower[2]; z < inner.upper[2]; ++z)
  {
    for (std::int64_t y = inner.lower[1]; y < inner.upper[1]; ++y)
    {
      for (std::int64_t x = inner.lower[0]; x < inner.upper[0]; ++x)
      {
        const Vector3 center{ { x + 0.5, y + 0.5, z + (volume.grid.IsActive(2) ? 0.5 : 0.0) } };
        Vector3       normal;
        if (std::abs(volume.DistanceTo(center)) > extent || !normals.Find(volume.gray, center, normal))
        {
          continue;
        }
        local.FindSamples(volume.gray, center, normal, itk::MedialVoxelWallFit::ReachOfWall, samples);
        const auto wall = fit.FitWall(samples);
        missing += wall ? 0 : 1;
        if (wall)
        {
          const double error = wall->thickness - thickness;
          errors.bias += error;
          errors.rms += error * error;
          errors.coverage += std::abs(error) <= 1.96 * wall->deviation ? 1.0 : 0.0;
          errors.unresolved += wall->isResolved ? 0 : 1;
          ++errors.cells;
        }
      }
    }
  }
  EXPECT_LE(200 * missing, errors.cells);
  const auto cells = static_cast<double>(errors.cells);
  errors.bias /= cells;
  errors.rms = std::sqrt(errors.rms / cells);
  errors.coverage /= cells;
  return errors;
}

itk::MedialVoxelScan
MakeScan(const double blur, const double noise)
{
  return { Background, Material, blur, noise * (Material - Background), 1.0 };
}

const Vector3 Normals[] = { { { 0, 0, 1 } }, { { 1, 2, 5 } }, { { 1, 1, 1 } }, { { 1, -1, 0 } }, { { 3, 1, -2 } } };
} // namespace

TEST(MedialVoxelWallFit, TheNormalDistributionIsThatOfTheLibrary)
{
  const auto & distribution = itk::MedialVoxelNormalDistribution::Get();
  for (int i = -9000; i <= 9000; ++i)
  {
    const double x = 0.001 * i + 0.00037;
    EXPECT_NEAR(distribution.Cumulative(x), Cumulative(x), 1e-8) << x;
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::acos(-1.0));
    EXPECT_NEAR(distribution.Density(x), density, 1e-9) << x;
    EXPECT_NEAR(distribution.Evaluate(x).cumulative, Cumulative(x), 1e-8) << x;
    EXPECT_NEAR(distribution.Evaluate(x).density, density, 1e-6) << x;
  }
}

TEST(MedialVoxelWallFit, CleanWallsAreExactAtAnyPlaceAndTilt)
{
  for (const Vector3 & normal : Normals)
  {
    for (const double thickness : { 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0 })
    {
      for (const double blur : { 0.58, 0.85, 1.04, 1.5 })
      {
        const Volume volume({ { 40, 40, 40 } }, normal, 0.23 + 0.1 * thickness, MakeWall(thickness, blur), 0.0);
        const Errors errors = MeasureErrors(volume, thickness, MakeScan(blur, 0.0));
        EXPECT_NEAR(errors.bias, 0.0, 0.005) << normal[0] << normal[1] << normal[2] << ' ' << thickness << ' ' << blur;
        EXPECT_LT(errors.rms, 0.01) << normal[0] << normal[1] << normal[2] << ' ' << thickness << ' ' << blur;
        EXPECT_EQ(errors.unresolved, 0u);
        EXPECT_GT(errors.cells, 100u);
      }
    }
  }
}

TEST(MedialVoxelWallFit, TheDeviationIsThatOfNoisyWalls)
{
  for (const double noise : { 0.1, 0.3 })
  {
    for (const double thickness : { 0.75, 1.0, 2.0, 4.0, 6.0 })
    {
      Errors sum;
      double coverage = 0.0;
      for (const Vector3 & normal : Normals)
      {
        const Volume volume({ { 44, 44, 44 } }, normal, 0.31, MakeWall(thickness, 0.85), noise);
        const Errors errors = MeasureErrors(volume, thickness, MakeScan(0.85, noise));
        sum.bias += errors.bias / 5.0;
        sum.rms += errors.rms / 5.0;
        coverage += errors.coverage / 5.0;
      }
      EXPECT_NEAR(sum.bias, 0.0, noise < 0.2 ? 0.02 : 0.06) << thickness << ' ' << noise;
      EXPECT_LT(sum.rms, 0.8 * noise) << thickness << ' ' << noise;
      EXPECT_GT(coverage, 0.90) << thickness << ' ' << noise;
      EXPECT_LT(coverage, 0.995) << thickness << ' ' << noise;
    }
  }
}

TEST(MedialVoxelWallFit, AWallBesideAnotherOneIsCutAtTheValley)
{
  for (const Vector3 & normal : Normals)
  {
    const Share  one = MakeWall(2.0, 0.85);
    const Share  other = MakeWall(3.0, 0.85, 4.5); // a gap of 2
    const Volume volume({ { 44, 44, 44 } }, normal, 0.1, [&](double s) { return one(s) + other(s); }, 0.0);
    const Errors errors = MeasureErrors(volume, 2.0, MakeScan(0.85, 0.0));
    EXPECT_NEAR(errors.bias, 0.0, 0.06) << normal[0] << normal[1] << normal[2];
    EXPECT_EQ(errors.unresolved, 0u);
  }
}

TEST(MedialVoxelWallFit, WallsThatTheBlurHasJoinedAreFlagged)
{
  for (const Vector3 & normal : Normals)
  {
    const Share  one = MakeWall(2.0, 1.2, -1.5);
    const Share  other = MakeWall(2.0, 1.2, 1.5); // a gap of 1
    const Volume volume({ { 44, 44, 44 } }, normal, 0.1, [&](double s) { return one(s) + other(s); }, 0.05);
    const Errors errors = MeasureErrors(volume, 5.0, MakeScan(1.2, 0.05));
    EXPECT_GT(static_cast<double>(errors.unresolved), 0.9 * static_cast<double>(errors.cells))
      << normal[0] << normal[1] << normal[2];
  }
}

TEST(MedialVoxelWallFit, AnImageOfOneSliceHasWallsToo)
{
  const Volume volume({ { 60, 60, 1 } }, { { 2, 1, 0 } }, 0.3, MakeWall(1.5, 0.85), 0.0);
  const Errors errors = MeasureErrors(volume, 1.5, MakeScan(0.85, 0.0));
  EXPECT_NEAR(errors.bias, 0.0, 0.01);
  EXPECT_GT(errors.cells, 20u);
}

namespace
{
itk::MedialVoxelScanSurvey::Source
MakeSource(const Volume & volume, const bool isReversed = false)
{
  itk::MedialVoxelScanSurvey::Source source;
  source.fill = [&volume](const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object, itk::MedialVoxelGray & gray) {
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x)
        {
          gray.GetRow(y, z)[x - box.lower[0]] = volume.gray.Get({ { x, y, z } });
          if (volume.object.Test({ { x, y, z } }))
          {
            object.Set({ { x, y, z } });
          }
        }
      }
    }
  };
  source.forEach = [isReversed](auto boxes, const auto & work) {
    if (isReversed)
    {
      std::reverse(boxes.begin(), boxes.end());
    }
    std::for_each(boxes.begin(), boxes.end(), work);
  };
  source.observe = [](double) {};
  return source;
}

constexpr double Threshold = 0.5 * (Background + Material);
} // namespace

TEST(MedialVoxelScanSurvey, FindsWhatTheValuesWereMadeOf)
{
  for (const double blur : { 0.58, 0.85, 1.24 })
  {
    for (const double noise : { 0.02, 0.1, 0.3 })
    {
      const Volume                     volume({ { 110, 60, 60 } }, { { 1, 2, 5 } }, 0.2, MakeWall(8.0, blur), noise);
      const itk::MedialVoxelScanSurvey survey(volume.grid, Threshold, std::nullopt);
      const auto                       result = survey.Run(MakeSource(volume));
      ASSERT_TRUE(result.scan) << result.reason << ' ' << blur << ' ' << noise;
      EXPECT_NEAR(result.scan->background, Background, 20.0);
      // The middle of a wall is lower by about 1 % of the contrast at most.
      EXPECT_NEAR(result.scan->material, Material, 0.012 * (Material - Background));
      EXPECT_NEAR(result.scan->blur, blur, 0.04 * blur + 0.1 * noise) << noise;
      EXPECT_NEAR(result.scan->GetRelativeNoise(), noise, 0.03 * noise) << blur;
      EXPECT_NEAR(result.scan->correlation, 1.0, 0.35) << blur << ' ' << noise;
      const auto other = survey.Run(MakeSource(volume, true));
      EXPECT_EQ(other.scan->blur, result.scan->blur);
      EXPECT_EQ(other.scan->background, result.scan->background);
      EXPECT_EQ(other.scan->noise, result.scan->noise);
    }
  }
}

TEST(MedialVoxelScanSurvey, AWallThatTheObjectLacksIsNotBackground)
{
  for (const double noise : { 0.0, 0.1, 0.3 })
  {
    for (const double thickness : { 0.5, 1.0 })
    {
      // It fills a third of the background beside the thick wall, and the whole of it on one side.
      const Share  thick = MakeWall(8.0, 0.85);
      const Share  thin = MakeWall(thickness, 0.85, 9.5);
      const Volume volume(
        { { 110, 60, 60 } }, { { 1, 2, 5 } }, 0.2, [&](double s) { return thick(s) + thin(s); }, noise);
      const itk::MedialVoxelScanSurvey survey(volume.grid, Threshold, std::nullopt);
      const auto                       result = survey.Run(MakeSource(volume));
      ASSERT_TRUE(result.scan) << result.reason;
      EXPECT_NEAR(result.scan->background, Background, 0.005 * (Material - Background)) << thickness << ' ' << noise;
      EXPECT_NEAR(result.scan->GetRelativeNoise(), noise, 0.04 * noise + 0.001) << thickness << ' ' << noise;
      EXPECT_NEAR(result.scan->correlation, 1.0, 0.35) << thickness << ' ' << noise;
    }
  }
}

namespace
{
/** Walls of 8 along an axis, each in blocks of its own, that cost nothing to make. */
itk::MedialVoxelScanSurvey::Source
MakeRows(std::int64_t & looked, const bool isReversed)
{
  itk::MedialVoxelScanSurvey::Source source;
  source.fill = [](const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object, itk::MedialVoxelGray & gray) {
    const Share wall = MakeWall(8.0, 0.85, 32.2);
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      const double share = wall(static_cast<double>(z % 64));
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x)
        {
          const auto random =
            static_cast<double>(itk::MedialVoxelHash((z * 4096 + y) * 4096 + x) >> 11) / 9007199254740992.0;
          const double value = share + 0.1 * (random - 0.5);
          gray.GetRow(y, z)[x - box.lower[0]] = static_cast<float>(Background + (Material - Background) * value);
          if (value >= 0.5)
          {
            object.Set({ { x, y, z } });
          }
        }
      }
    }
  };
  source.forEach = [&looked, isReversed](auto boxes, const auto & work) {
    for (const itk::MedialVoxelBox & box : boxes)
    {
      looked += box.NumberOfVoxels();
    }
    if (isReversed)
    {
      std::reverse(boxes.begin(), boxes.end());
    }
    std::for_each(boxes.begin(), boxes.end(), work);
  };
  source.observe = [](double) {};
  return source;
}
} // namespace

TEST(MedialVoxelScanSurvey, EndsWhenTheSamplesAreEnough)
{
  const itk::MedialVoxelGrid       grid({ { 640, 640, 640 } }, { { 1.0, 1.0, 1.0 } });
  const itk::MedialVoxelScanSurvey survey(grid, Threshold, std::nullopt);
  std::int64_t                     looked[2] = {};
  const auto                       result = survey.Run(MakeRows(looked[0], false));
  const auto                       other = survey.Run(MakeRows(looked[1], true));
  ASSERT_TRUE(result.scan && other.scan) << result.reason;
  EXPECT_LT(3 * looked[0], grid.GetVoxelBox().NumberOfVoxels());
  EXPECT_EQ(looked[0], looked[1]);
  EXPECT_EQ(result.scan->blur, other.scan->blur);
  EXPECT_EQ(result.scan->background, other.scan->background);
  EXPECT_EQ(result.scan->material, other.scan->material);
  EXPECT_EQ(result.scan->noise, other.scan->noise);
  EXPECT_EQ(result.scan->correlation, other.scan->correlation);
  EXPECT_NEAR(result.scan->blur, 0.85, 0.03);
}

TEST(MedialVoxelScanSurvey, SaysWhyThereIsNone)
{
  const auto reasonOf = [](const Share & share, const double threshold) {
    const Volume volume({ { 60, 60, 60 } }, { { 0, 0, 1 } }, 0.2, share, 0.0);
    return itk::MedialVoxelScanSurvey(volume.grid, threshold, std::nullopt).Run(MakeSource(volume)).reason;
  };
  EXPECT_EQ(reasonOf([](double) { return 1.0; }, Threshold), "the values are those of a mask or a label map");
  EXPECT_NE(reasonOf(MakeWall(3.0, 0.8), Threshold).find("too few walls are 5 voxels thick"), std::string::npos);
  EXPECT_EQ(reasonOf(MakeWall(8.0, 0.8), Material + 1.0),
            "the threshold is not between the values of background and material");
  EXPECT_EQ(reasonOf([](double s) { return std::abs(s) < 4.0 ? 1.0 : 0.0; }, Threshold),
            "the values are those of a mask or a label map");
}

TEST(MedialVoxelScanSurvey, WallsThatTheObjectLacksOnBothSidesAreTheReason)
{
  const Share  thick = MakeWall(8.0, 0.8);
  const Share  below = MakeWall(0.8, 0.8, -7.5);
  const Share  above = MakeWall(0.8, 0.8, 7.5);
  const Volume volume(
    { { 60, 60, 60 } }, { { 1, 2, 5 } }, 0.2, [&](double s) { return thick(s) + below(s) + above(s); }, 0.02);
  const auto result = itk::MedialVoxelScanSurvey(volume.grid, Threshold, std::nullopt).Run(MakeSource(volume));
  ASSERT_FALSE(result.scan);
  EXPECT_EQ(result.reason, "the values beside too many walls are not flat, so that the blur is not known");
}

TEST(MedialVoxelScanSurvey, LevelsThatAreKnownNeedNoThickWallsButTheBlurDoes)
{
  const Volume                     volume({ { 60, 60, 60 } }, { { 0, 0, 1 } }, 0.2, MakeWall(8.0, 0.8), 0.05);
  const itk::MedialVoxelScanLevels levels{ Background - 10.0, Material + 10.0 };
  const auto result = itk::MedialVoxelScanSurvey(volume.grid, Threshold, levels).Run(MakeSource(volume));
  ASSERT_TRUE(result.scan);
  EXPECT_EQ(result.scan->background, levels.background);
  EXPECT_EQ(result.scan->material, levels.material);
}

TEST(MedialVoxelRandomSample, IsTheSameInAnyOrderAndDivision)
{
  itk::MedialVoxelRandomSample<int> forwards(100);
  itk::MedialVoxelRandomSample<int> backwards(100);
  itk::MedialVoxelRandomSample<int> parts(100);
  const auto                        hashOf = [](int i) { return itk::MedialVoxelHash(static_cast<std::uint64_t>(i)); };
  for (int i = 0; i < 10000; ++i)
  {
    forwards.Add(hashOf(i), i);
    backwards.Add(hashOf(9999 - i), 9999 - i);
  }
  for (int first = 0; first < 10000; first += 1000)
  {
    itk::MedialVoxelRandomSample<int> part(100);
    part.LimitTo(parts);
    for (int i = first; i < first + 1000; ++i)
    {
      part.Add(hashOf(i), i);
    }
    parts.Add(std::move(part));
  }
  const std::vector<int> items = forwards.Take();
  EXPECT_EQ(items.size(), 100u);
  EXPECT_EQ(backwards.Take(), items);
  EXPECT_EQ(parts.Take(), items);
}

TEST(MedialVoxelWallFit, ValuesThatSayNothingAreNoMeasure)
{
  // Random walls in noise as high as they are: some fits end where the values no longer decide on the surfaces.
  std::mt19937_64                    random(9);
  std::normal_distribution<>         normalDistribution;
  std::uniform_real_distribution<>   uniform(0.0, 1.0);
  itk::MedialVoxelGrayLocal::Samples samples;
  std::size_t                        found = 0;
  for (int repetition = 0; repetition < 20000; ++repetition)
  {
    const double                  blur = 0.3 + uniform(random);
    const itk::MedialVoxelWallFit fit(MakeScan(blur, 1.0), 3);
    const Share                   wall = MakeWall(4.0 * uniform(random), blur, 2.0 * uniform(random) - 1.0);
    samples.Clear();
    for (int i = -80; i <= 80; ++i)
    {
      samples.Add(0.1 * i, 1.0, wall(0.1 * i) + normalDistribution(random));
    }
    if (const auto measured = fit.FitWall(samples))
    {
      ++found;
      EXPECT_GT(measured->thickness, 0.0);
      EXPECT_LT(measured->thickness, 20.0);
      EXPECT_LE(measured->deviation, 4.0);
    }
    if (const auto surface = fit.FitSurface(samples))
    {
      EXPECT_LT(std::abs(surface->place), 8.0);
      EXPECT_LE(surface->deviation, 1.0);
    }
  }
  EXPECT_GT(found, 1000u);
}
