// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelPairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace
{
using Pairing = itk::MedialVoxelPairing;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/** The most pairs, by all choices for the lowest node. */
int
CountByBruteForce(const std::set<Edge> & edges, const unsigned int nodes, const unsigned int used = 0)
{
  unsigned int node = 0;
  while (node < nodes && (used >> node & 1u) != 0)
  {
    ++node;
  }
  if (node == nodes)
  {
    return 0;
  }
  int most = CountByBruteForce(edges, nodes, used | 1u << node);
  for (unsigned int other = node + 1; other < nodes; ++other)
  {
    if ((used >> other & 1u) == 0 && edges.count({ node, other }) > 0)
    {
      most = std::max(most, 1 + CountByBruteForce(edges, nodes, used | 1u << node | 1u << other));
    }
  }
  return most;
}

TEST(MedialVoxelPairing, FindsAsManyPairsAsThereCanBe)
{
  std::mt19937 random(7);
  int          longWays = 0;
  for (int round = 0; round < 600; ++round)
  {
    const auto        nodes = static_cast<unsigned int>(4 + random() % 9);
    std::vector<Edge> order;
    std::set<Edge>    edges;
    for (unsigned int k = 0; k < nodes + random() % nodes; ++k)
    {
      const Edge edge = std::minmax(random() % nodes, random() % nodes);
      if (edge.first != edge.second && edges.insert(edge).second)
      {
        order.push_back(edge);
      }
    }
    Pairing pairing(nodes);
    for (const Edge & edge : order)
    {
      pairing.Allow(edge.first, edge.second);
    }
    const auto count = [&] {
      int number = 0;
      for (std::uint32_t node = 0; node < nodes; ++node)
      {
        const std::uint32_t partner = pairing.GetPartner(node);
        if (partner != Pairing::None)
        {
          EXPECT_EQ(pairing.GetPartner(partner), node);
          EXPECT_EQ(edges.count(std::minmax(node, partner)), 1u);
          ++number;
        }
      }
      return number / 2;
    };
    const int before = count();
    pairing.Extend();
    EXPECT_EQ(count(), CountByBruteForce(edges, nodes));
    longWays += count() > before ? 1 : 0;
  }
  EXPECT_GT(longWays, 100); // pairs that the order alone does not make
}

/** A circle of five nodes with a tail at each of two: the way between the tails goes round the circle. */
TEST(MedialVoxelPairing, GoesRoundCirclesOfOddLength)
{
  Pairing pairing(8);
  for (const Edge & edge :
       std::vector<Edge>{ { 1, 2 }, { 3, 4 }, { 0, 1 }, { 2, 3 }, { 4, 0 }, { 0, 5 }, { 5, 6 }, { 3, 7 } })
  {
    pairing.Allow(edge.first, edge.second);
  }
  pairing.Extend();
  for (std::uint32_t node = 0; node < 8; ++node)
  {
    EXPECT_NE(pairing.GetPartner(node), Pairing::None);
  }
}
} // namespace
