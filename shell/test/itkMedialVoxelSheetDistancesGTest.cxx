// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSheetDistances.h"

#include "MedialVoxelTestElements.h"
#include "MedialVoxelTestPhantoms.h"
#include "MedialVoxelTestSupport.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace
{
using namespace MedialVoxelTest;

TEST(MedialVoxelDistanceHistogram, MeanLargestAndMostOfTheNumbers)
{
  std::mt19937                        random(3);
  std::lognormal_distribution<double> distribution(0.0, 1.0);
  std::vector<double>                 numbers;
  itk::MedialVoxelDistanceHistogram   histogram;
  for (int k = 0; k < 5000; ++k)
  {
    numbers.push_back(k % 10 == 0 ? 0.0 : distribution(random));
    histogram.Add(numbers.back());
  }
  const auto found = histogram.Summarize();
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(found.largest, numbers.back());
  EXPECT_NEAR(found.mean, std::accumulate(numbers.begin(), numbers.end(), 0.0) / 5000.0, 1e-9);
  EXPECT_NEAR(found.most / numbers[4949], 1.0, 0.002);
  EXPECT_EQ(itk::MedialVoxelDistanceHistogram().Summarize().largest, 0.0);
}

/** Any division of the fine sheet gives what comparison of all with all gives. */
TEST(MedialVoxelSheetDistances, EqualsBruteForceForAnyParts)
{
  const Volume                volume = TeeJunction({ { 30, 20, 26 } }, 5, 3);
  const itk::MedialVoxelSheet sheet = SheetOf(MakeSurface(volume, 4.0));
  const auto                  remeshed = itk::MedialVoxelRemesh(sheet, { 4.0, false, true }, {});
  const Faces                 coarse = FacesOf(remeshed);
  double                      largest = 0.0;
  double                      sum = 0.0;
  for (const Vector3 & point : sheet.points)
  {
    double nearest = 1e30;
    for (const auto & face : coarse.faces)
    {
      for (std::size_t k = 2; k < face.size(); ++k)
      {
        const Vector3 on = itk::MedialVoxelNearestOfTriangle(
          point, { { coarse.points[face[0]], coarse.points[face[k - 1]], coarse.points[face[k]] } });
        nearest = std::min(nearest, itk::MedialVoxelNorm(itk::MedialVoxelSubtract(on, point)));
      }
    }
    largest = std::max(largest, nearest);
    sum += nearest;
  }

  for (const std::size_t parts : { 1u, 3u, 7u })
  {
    itk::MedialVoxelSheetDistances distances(remeshed);
    const std::size_t              points = (sheet.points.size() + parts - 1) / parts;
    for (const double within : { 0.02, itk::MedialVoxelSheetTree::Anywhere })
    {
      ASSERT_TRUE(distances.BeginSamples(within));
      for (std::size_t part = 0; part < parts; ++part)
      {
        itk::MedialVoxelSheet some = sheet;
        some.triangles.clear();
        for (std::size_t k = part; k < sheet.triangles.size(); k += parts)
        {
          some.triangles.push_back(sheet.triangles[k]);
        }
        distances.Add(distances.MeasureSamples(some));
      }
    }
    ASSERT_FALSE(distances.BeginSamples(itk::MedialVoxelSheetTree::Anywhere));
    for (std::size_t part = 0; part < parts; ++part)
    {
      itk::MedialVoxelSheet some;
      const auto            first = sheet.points.begin() + static_cast<std::ptrdiff_t>(part * points);
      some.points.assign(first, std::min(first + static_cast<std::ptrdiff_t>(points), sheet.points.end()));
      distances.Add(distances.MeasurePoints(some));
    }
    itk::MedialVoxelRemeshingSummary summary;
    distances.Summarize(summary);
    EXPECT_NEAR(summary.fromFine.largest, largest, 1e-12);
    EXPECT_NEAR(summary.fromFine.mean, sum / static_cast<double>(sheet.points.size()), 1e-12);
    static double ofWhole = 0.0;
    ofWhole = parts == 1 ? summary.toFine.mean : ofWhole;
    EXPECT_NEAR(summary.toFine.mean, ofWhole, 1e-12);
    EXPECT_GT(summary.toFine.mean, 0.0);
    EXPECT_LE(summary.toFine.mean, summary.toFine.largest);
  }
}
} // namespace
