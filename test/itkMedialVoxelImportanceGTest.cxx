// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The geodesic distance of the pair of each cell, against a search over the whole boundary and against labels.

#include "itkMedialVoxelObjectsImageFilter.h"

#include "MedialVoxelTestClassification.h"
#include "MedialVoxelTestPhantoms.h"
#include "MedialVoxelTestRuns.h"

#include "itkStreamingImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace
{
using namespace MedialVoxelTest;
using Values = std::vector<float>;

struct Subject
{
  std::string name;
  Volume      volume;
  double      largest; ///< thickness
};

/** The last search box is wider than a word. */
std::vector<Subject>
Subjects()
{
  const Vector3 cranium{ { 0.9570312, 0.9570312, 1.5 } };
  return { { "boxes", RandomBoxes({ { 40, 25, 21 } }, UnitSpacing, 20, 81), 7.0 },
           { "cranium spacing", RandomBoxes({ { 31, 28, 19 } }, cranium, 18, 82), 9.0 },
           { "two dimensions", RandomBoxes({ { 67, 53, 1 } }, UnitSpacing, 20, 83), 8.0 },
           { "wide boxes", RandomBoxes({ { 90, 12, 11 } }, UnitSpacing, 9, 84), 50.0 } };
}

template <unsigned int D>
typename MedialFilter<D>::Pointer
MakeFilter(const Subject & subject)
{
  auto filter = MakeMedialFilter<D>(subject.volume, subject.largest);
  filter->GenerateImportanceOn();
  return filter;
}

template <unsigned int D>
Values
FindImportance(const Subject & subject)
{
  auto filter = MakeFilter<D>(subject);
  filter->UpdateLargestPossibleRegion();
  return PixelsOf(filter->GetImportanceOutput());
}

Values
FindImportance(const Subject & subject)
{
  return subject.volume.size[2] == 1 ? FindImportance<2>(subject) : FindImportance<3>(subject);
}

/** The pair of each cell by the definition, and Dijkstra's algorithm over the whole boundary. */
Values
SearchImportance(const Subject & subject)
{
  const Volume &                      volume = subject.volume;
  const std::vector<Index3>           sites = BoundarySites(volume);
  const std::vector<long>             nearest = NearestBoundaryPoints(volume, sites);
  const BoundaryGraph                 graph(volume, sites);
  const double                        cap = EpsilonOf(subject.largest);
  Values                              importance(volume.object.size(), 0.0F);
  std::map<long, std::vector<double>> distances;
  for (std::size_t i = 0; i < importance.size(); ++i)
  {
    const Index3 cell = volume.IndexAt(i);
    const Pair   pair = IsCandidate(volume, cell) ? ChoosePair(volume, sites, nearest, cell) : Pair{};
    if (!pair.defined || IsTrivialPair(volume, sites[pair.ni], sites[pair.nj], std::numeric_limits<double>::max()))
    {
      continue;
    }
    auto & fromPoint = distances[pair.ni];
    if (fromPoint.empty())
    {
      fromPoint = graph.DistancesFrom(static_cast<int>(pair.ni), cap);
    }
    importance[i] = static_cast<float>(std::min(fromPoint[static_cast<std::size_t>(pair.nj)], cap));
  }
  return importance;
}

template <unsigned int D>
std::vector<unsigned char>
FindLabels(const Volume & volume, const double thickness)
{
  return RunMedialFilter<D>(volume, thickness).labels;
}

} // namespace

TEST(Importance, IsTheLengthOfTheShortestPath)
{
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    const Values found = FindImportance(subject);
    const Values expected = SearchImportance(subject);
    ASSERT_EQ(found.size(), expected.size());
    std::size_t between = 0;
    const auto  cap = static_cast<float>(EpsilonOf(subject.largest));
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      // Sums of the same edges in another order.
      ASSERT_NEAR(found[i], expected[i], 2e-7F * expected[i]) << i;
      between += found[i] > 0.0F && found[i] < cap ? 1 : 0;
    }
    EXPECT_GT(between, 100u);
    EXPECT_LE(*std::max_element(found.begin(), found.end()), cap);
  }
}

TEST(Importance, ThresholdsGiveTheCellsOfEachThickness)
{
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    const Values importance = FindImportance(subject);
    for (double thickness = 2.0; thickness <= subject.largest; thickness += thickness < 9.0 ? 0.37 : 5.3)
    {
      const auto labels = subject.volume.size[2] == 1 ? FindLabels<2>(subject.volume, thickness)
                                                      : FindLabels<3>(subject.volume, thickness);
      const auto limit = static_cast<float>(EpsilonOf(thickness));
      for (std::size_t i = 0; i < labels.size(); ++i)
      {
        ASSERT_EQ(importance[i] >= limit, labels[i] >= 2) << thickness << ' ' << i;
      }
    }
  }
}

TEST(Importance, AutomaticThicknessHasItUpToItsMaximum)
{
  const Subject subject = Subjects()[0];
  auto          filter = MakeFilter<3>(subject);
  filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  filter->SetMaximumThickness(subject.largest);
  filter->SetMaximumPoreSize(0);
  filter->UpdateLargestPossibleRegion();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetImportanceOutput()), FindImportance(subject)));
}

TEST(Importance, ThresholdsOfCellsGiveTheSheet)
{
  for (const Subject & subject : { Subjects()[0], Subjects()[1], Subjects()[3] })
  {
    for (const bool isAutomatic : { true, false })
    {
      SCOPED_TRACE(subject.name + (isAutomatic ? ", automatic" : ""));
      Values thresholds;
      for (const unsigned int threads : { 1u, 3u })
      {
        auto filter = MakeFilter<3>(subject);
        filter->GenerateImportanceThresholdOn();
        filter->SetNumberOfWorkUnits(threads);
        if (isAutomatic)
        {
          filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
          filter->SetMaximumThickness(subject.largest);
          filter->SetSmoothing(itk::MedialVoxelSmoothing::Off);
        }
        filter->UpdateLargestPossibleRegion();
        const auto   labels = PixelsOf(filter->GetOutput());
        const Values importance = PixelsOf(filter->GetImportanceOutput());
        const Values own = PixelsOf(filter->GetImportanceThresholdOutput());
        EXPECT_EQ(filter->GetImportanceThresholdOutput()->GetOrigin(), filter->GetOutput()->GetOrigin());
        for (std::size_t i = 0; i < labels.size(); ++i)
        {
          ASSERT_EQ(own[i] > 0.0F, importance[i] > 0.0F) << i;
          ASSERT_EQ(own[i] > 0.0F && importance[i] >= own[i], labels[i] >= 2) << i;
        }
        EXPECT_TRUE(threads == 1 || AreEqual(own, thresholds));
        thresholds = own;
      }
      const auto [least, most] = std::minmax_element(thresholds.begin(), thresholds.end());
      EXPECT_EQ(*least, 0.0F);
      EXPECT_LE(*most, std::nextafter(static_cast<float>(EpsilonOf(subject.largest)), 1e9F));
      const std::set<float> all(thresholds.begin(), thresholds.end());
      EXPECT_TRUE(isAutomatic ? all.size() > 3 : all.size() <= 3) << all.size();
    }
  }
}

TEST(Importance, DivisionAndThreadsDoNotChangeIt)
{
  for (const Subject & subject : { Subjects()[0], Subjects()[1], Subjects()[3] })
  {
    SCOPED_TRACE(subject.name);
    const Values whole = FindImportance(subject);
    for (const unsigned int pieces : { 2u, 5u, 11u })
    {
      auto filter = MakeFilter<3>(subject);
      filter->SetNumberOfWorkUnits(pieces % 4 + 1);
      using Importance = MedialFilter<3>::ThicknessImageType;
      auto streamer = itk::StreamingImageFilter<Importance, Importance>::New();
      streamer->SetInput(filter->GetImportanceOutput());
      streamer->SetNumberOfStreamDivisions(pieces);
      streamer->Update();
      EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), whole));
    }
  }
}

TEST(Importance, ComesAndGoes)
{
  auto filter = MakeMedialFilter<3>(Subjects()[0].volume, 3.0);
  EXPECT_FALSE(filter->GetGenerateImportance());
  EXPECT_EQ(filter->GetImportanceOutput(), nullptr);
  filter->GenerateImportanceOn();
  filter->UpdateLargestPossibleRegion();
  EXPECT_EQ(filter->GetImportanceOutput()->GetOrigin(), filter->GetOutput()->GetOrigin());
  filter->GenerateImportanceOff();
  EXPECT_EQ(filter->GetImportanceOutput(), nullptr);
  EXPECT_EQ(filter->GetImportanceThresholdOutput(), nullptr);
}

TEST(Importance, IsOfOneObject)
{
  auto filter = itk::MedialVoxelObjectsImageFilter<MaskImage<3>>::New();
  filter->SetInput(MakeImage<MaskImage<3>>(Subjects()[0].volume));
  filter->GenerateImportanceOn();
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  filter->GenerateImportanceOff();
  filter->GenerateImportanceThresholdOn();
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
}
