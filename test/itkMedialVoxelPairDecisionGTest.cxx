// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelPairDecision.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelPairDecision;
namespace Label = itk::MedialVoxelLabel;
using BoundEnum = itk::MedialVoxelPseudoGeodesicBound;

itk::MedialVoxelPair
PairOf(const Index3 & a, const Index3 & b)
{
  itk::MedialVoxelPair pair{};
  for (int axis = 0; axis < 3; ++axis)
  {
    pair.a[axis] = a[axis];
    pair.difference[axis] = a[axis] - b[axis];
  }
  return pair;
}

itk::MedialVoxelParameters
ParametersOf(double epsilon, BoundEnum bound)
{
  itk::MedialVoxelParameters parameters;
  parameters.epsilon = epsilon;
  parameters.bound = bound;
  return parameters;
}

/** Whether each pair of sites, some of them, has the label of the definition with and without the bound. */
void
ExpectDefinition(const Volume & volume, double epsilon)
{
  const auto                         sites = BoundarySites(volume);
  const auto                         image = GridOf(volume).GetVoxelBox();
  const auto                         bits = SiteBits(sites, image);
  const BoundaryGraph                graph(volume, sites);
  const MedialVoxelPairDecision      bounded(GridOf(volume), ParametersOf(epsilon, BoundEnum::FreeSpace));
  const MedialVoxelPairDecision      unbounded(GridOf(volume), ParametersOf(epsilon, BoundEnum::Off));
  MedialVoxelPairDecision::Workspace workspace;
  MedialVoxelPairDecision::Workspace unboundedWorkspace;
  itk::MedialVoxelBox                missing;
  bounded.Begin(bits, image, workspace);
  unbounded.Begin(bits, image, unboundedWorkspace);
  std::map<int, int> seen;
  for (std::size_t source = 0; source < sites.size(); source += sites.size() / 20 + 1)
  {
    const auto distances = graph.DistancesFrom(static_cast<int>(source), 2 * epsilon);
    for (std::size_t target = 0; target < sites.size(); target += 3)
    {
      if (IsTrivialPair(volume, sites[source], sites[target], epsilon))
      {
        continue;
      }
      const auto pair = PairOf(sites[source], sites[target]);
      const int  label = bounded.Decide(bits, pair, workspace, missing);
      ++seen[label];
      ASSERT_EQ(label != Label::NonMedial, distances[target] >= epsilon);
      ASSERT_EQ(label == Label::MedialByBound, FreeSpaceLength(volume, sites[source], sites[target]) >= epsilon);
      ASSERT_EQ(unbounded.Decide(bits, pair, unboundedWorkspace, missing),
                distances[target] >= epsilon ? Label::MedialByGeodesic : Label::NonMedial);
    }
  }
  EXPECT_TRUE(missing.IsEmpty());
  EXPECT_GT(seen[Label::NonMedial], 0);
  EXPECT_GT(seen[Label::MedialByBound], 0);
  EXPECT_GT(seen[Label::MedialByGeodesic], 0);
}
} // namespace

TEST(MedialVoxelPairDecision, JudgesLikePlainDijkstra)
{
  for (const double epsilon : { 3.1, 4.71, 7.9, 12.3 })
  {
    ExpectDefinition(RandomBoxes({ { 24, 21, 20 } }, UnitSpacing, 12, 401), epsilon);
    ExpectDefinition(RandomVolume({ { 40, 37, 1 } }, UnitSpacing, 0.6, 402), epsilon);
    ExpectDefinition(RandomBoxes({ { 20, 21, 16 } }, { { 0.7, 1.1, 1.3 } }, 10, 403), epsilon);
  }
}

TEST(MedialVoxelPairDecision, SmallBoundariesSayWhatTheyMiss)
{
  const Volume                       plate = AxisPlate({ { 30, 30, 20 } }, UnitSpacing, 2, 8, 4);
  const auto                         sites = BoundarySites(plate);
  const auto                         small = SiteBits(sites, MakeBox({ { 13, 13, 6 } }, { { 17, 17, 14 } }));
  const auto                         pair = PairOf({ { 15, 15, 7 } }, { { 15, 15, 12 } });
  const MedialVoxelPairDecision      decision(GridOf(plate), ParametersOf(9.0, BoundEnum::FreeSpace));
  MedialVoxelPairDecision::Workspace workspace;
  itk::MedialVoxelBox                missing;
  decision.Begin(small, small.GetBox(), workspace);
  decision.Decide(small, pair, workspace, missing);
  ASSERT_FALSE(missing.IsEmpty());
  const auto          enough = SiteBits(sites, missing);
  itk::MedialVoxelBox none;
  decision.Begin(enough, enough.GetBox(), workspace);
  EXPECT_EQ(decision.Decide(enough, pair, workspace, none), Label::MedialByGeodesic);
  EXPECT_TRUE(none.IsEmpty());
}
