// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelBoundaryDistances.h"
#include "itkMedialVoxelGeodesicLandmarks.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace
{
using namespace MedialVoxelTest;
using NodeType = itk::MedialVoxelBoundaryGraph::NodeType;

const Vector3 CraniumSpacing{ { 0.9570312, 0.9570312, 1.5 } };

/** Scattered sites of a volume that is longer than two words, so that rows of a graph cross words. */
std::vector<Index3>
ScatteredSites(const Index3 & size, unsigned int oneIn, unsigned int seed)
{
  std::mt19937        generator(seed);
  std::vector<Index3> sites;
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        if (generator() % oneIn == 0)
        {
          sites.push_back({ { x, y, z } });
        }
      }
    }
  }
  return sites;
}

/** The sites of a box, in the order of the graph. */
std::vector<Index3>
SitesIn(const std::vector<Index3> & sites, const itk::MedialVoxelBox & box)
{
  std::vector<Index3> inside;
  std::copy_if(sites.begin(), sites.end(), std::back_inserter(inside), [&](const Index3 & site) {
    return box.Contains(KernelIndex(site));
  });
  return inside;
}

struct Case
{
  Vector3             spacing;
  itk::MedialVoxelBox box;
  unsigned int        oneIn;
};

std::vector<Case>
Cases()
{
  return { { UnitSpacing, { { { 0, 0, 0 } }, { { 140, 9, 8 } } }, 4 },
           { UnitSpacing, { { { 1, 1, 1 } }, { { 64, 8, 7 } } }, 8 },
           { CraniumSpacing, { { { 62, 0, 2 } }, { { 128, 9, 8 } } }, 3 },
           { CraniumSpacing, { { { 63, 3, 3 } }, { { 64, 4, 8 } } }, 2 },
           { { { 2.0, 0.4, 1.0 } }, { { { 5, 2, 0 } }, { { 139, 7, 6 } } }, 12 } };
}

const Index3 Size{ { 140, 9, 8 } };
} // namespace

TEST(MedialVoxelBoundaryGraph, HasTheNeighborsAndComponentsOfTheBox)
{
  unsigned int seed = 800;
  for (const Case & testCase : Cases())
  {
    const Volume                  volume(Size, testCase.spacing);
    const auto                    all = ScatteredSites(Size, testCase.oneIn, ++seed);
    const auto                    sites = SitesIn(all, testCase.box);
    const BoundaryGraph           oracle(volume, sites);
    itk::MedialVoxelBoundaryGraph graph;
    ASSERT_TRUE(graph.Build(SiteBits(all, GridOf(volume).GetVoxelBox()), testCase.box, sites.size()));
    ASSERT_EQ(graph.GetNumberOfNodes(), sites.size());
    std::map<std::pair<NodeType, NodeType>, unsigned int> expected;
    for (NodeType node = 0; node < sites.size(); ++node)
    {
      ASSERT_EQ(graph.NodeOf(KernelIndex(sites[node])), node);
      ASSERT_EQ(graph.IndexOf(node), KernelIndex(sites[node]));
      const auto  distances = oracle.DistancesFrom(static_cast<int>(node));
      std::size_t neighbors = 0;
      for (NodeType other = 0; other < sites.size(); ++other)
      {
        const auto isNear = [&](int axis) { return std::abs(sites[node][axis] - sites[other][axis]) <= 1; };
        neighbors += other != node && isNear(0) && isNear(1) && isNear(2) ? 1 : 0;
        ASSERT_EQ(graph.AreConnected(node, other), !std::isinf(distances[other]));
      }
      std::set<NodeType> seen;
      graph.VisitNeighbors(node, [&](const NodeType other, const unsigned int mask) {
        unsigned int changed = 0;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          changed |= sites[node][axis] != sites[other][axis] ? 1u << axis : 0u;
        }
        EXPECT_EQ(mask, changed);
        seen.insert(other);
      });
      ASSERT_EQ(seen.size(), neighbors);
    }
  }
}

TEST(MedialVoxelBoundaryGraph, RefusesMoreNodesThanAllowed)
{
  const Volume                  volume(Size, UnitSpacing);
  const auto                    sites = ScatteredSites(Size, 3, 811);
  const auto                    bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
  itk::MedialVoxelBoundaryGraph graph;
  EXPECT_FALSE(graph.Build(bits, bits.GetBox(), sites.size() - 1));
  EXPECT_TRUE(graph.GetBox().IsEmpty());
  EXPECT_TRUE(graph.Build(bits, bits.GetBox(), sites.size()));
  EXPECT_EQ(graph.GetBox(), bits.GetBox());
}

namespace
{
/** The scattered sites of a case as a graph, beside the oracle for it. */
struct Scene
{
  Scene(const Case & testCase, unsigned int seed)
    : volume(Size, testCase.spacing)
    , grid(GridOf(volume))
    , sites(SitesIn(ScatteredSites(Size, testCase.oneIn, seed), testCase.box))
    , oracle(volume, sites)
  {
    EXPECT_TRUE(graph.Build(SiteBits(sites, grid.GetVoxelBox()), testCase.box, sites.size()));
  }

  Volume                        volume;
  itk::MedialVoxelGrid          grid;
  std::vector<Index3>           sites;
  BoundaryGraph                 oracle;
  itk::MedialVoxelBoundaryGraph graph;
};

/** Compares a length with that of the oracle, if it is within the radius. */
void
ExpectLength(double length, double expected, double radius)
{
  if (expected <= radius)
  {
    EXPECT_NEAR(length, expected, 1e-12);
  }
  else
  {
    EXPECT_EQ(length, itk::MedialVoxelBoundaryDistances::NotReached);
  }
}
} // namespace

TEST(MedialVoxelBoundaryDistances, AreThoseOfPlainDijkstra)
{
  unsigned int seed = 820;
  for (const Case & testCase : Cases())
  {
    const Scene                       scene(testCase, ++seed);
    itk::MedialVoxelBoundaryDistances distances;
    // The workspace serves one search after the other, with growing and shrinking radius.
    for (const double radius : { 3.0, 40.0, 7.0, 0.1 })
    {
      const auto source = static_cast<NodeType>(++seed % scene.sites.size());
      const auto expected = scene.oracle.DistancesFrom(static_cast<int>(source));
      distances.Compute(scene.graph, scene.grid, source, radius);
      for (NodeType node = 0; node < scene.sites.size(); ++node)
      {
        ExpectLength(distances.GetLengths()[node], expected[node], radius);
      }
    }
  }
}

TEST(MedialVoxelBoundaryDistances, EndAtTheTarget)
{
  unsigned int seed = 825;
  for (const Case & testCase : Cases())
  {
    const Scene                       scene(testCase, ++seed);
    itk::MedialVoxelBoundaryDistances distances;
    const auto                        expected = scene.oracle.DistancesFrom(0);
    for (NodeType target = 0; target < scene.sites.size(); target += 3)
    {
      distances.ComputeTowards(scene.graph, scene.grid, 0, target, 9.0);
      ExpectLength(distances.GetLengths()[target], expected[target], 9.0);
    }
  }
}

TEST(MedialVoxelGeodesicLandmarks, NeverContradictTheDistances)
{
  using Result = itk::MedialVoxelGeodesicLandmarks::Result;
  const Volume                      volume = Ball({ { 26, 26, 26 } }, CraniumSpacing, { { 12, 12, 12 } }, 10.3);
  const auto                        sites = BoundarySites(volume);
  const BoundaryGraph               oracle(volume, sites);
  itk::MedialVoxelBoundaryGraph     graph;
  itk::MedialVoxelBoundaryDistances distances;
  const auto                        bits = SiteBits(sites, GridOf(volume).GetVoxelBox());
  ASSERT_TRUE(graph.Build(bits, bits.GetBox(), sites.size()));
  std::map<Index3, NodeType> nodeOf;
  for (const Index3 & site : sites)
  {
    nodeOf[site] = graph.NodeOf(KernelIndex(site));
  }

  constexpr double                  epsilon = 9.0;
  constexpr double                  radius = 13.0;
  itk::MedialVoxelGeodesicLandmarks landmarks;
  EXPECT_EQ(landmarks.Compare(0, 1, epsilon, epsilon), Result::Undecided);
  std::mt19937          generator(830);
  std::map<Result, int> seen;
  // More landmarks than are kept.
  for (int round = 0; round < 40; ++round)
  {
    distances.Compute(graph, GridOf(volume), static_cast<NodeType>(generator() % sites.size()), radius);
    landmarks.Add(distances.GetLengths(), radius);
    const auto source = generator() % sites.size();
    const auto expected = oracle.DistancesFrom(static_cast<int>(source));
    for (std::size_t target = 0; target < sites.size(); ++target)
    {
      const Result result = landmarks.Compare(nodeOf[sites[source]], nodeOf[sites[target]], epsilon, epsilon);
      ++seen[result];
      if (result != Result::Undecided)
      {
        ASSERT_EQ(result == Result::Longer, expected[target] > epsilon);
      }
    }
  }
  for (const Result result : { Result::Longer, Result::Shorter, Result::Undecided })
  {
    EXPECT_GT(seen[result], 100);
  }
  landmarks.Clear();
  EXPECT_EQ(landmarks.Compare(0, 0, epsilon, epsilon), Result::Undecided);
}
