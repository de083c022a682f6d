// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// What is found by bits agrees with the edges one by one.

#include "itkMedialVoxelSurfaceTopology.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using Topology = itk::MedialVoxelSurfaceTopology;

constexpr unsigned int NumberOfMasks = 1u << Topology::NumberOfEdges;

bool
HasEdge(unsigned int mask, unsigned int edge)
{
  return (mask >> edge & 1) != 0;
}

/** Edges of \a mask that are joined with its lowest one through faces between them. */
unsigned int
PartOfLowest(unsigned int mask)
{
  unsigned int part = mask & (~mask + 1);
  for (unsigned int before = 0; before != part;)
  {
    before = part;
    for (unsigned int direction = 0; direction < Topology::NumberOfDirections; ++direction)
    {
      const unsigned int face = Topology::EdgesTowards(direction);
      part |= (part & face) != 0 ? mask & face : 0;
    }
  }
  return part;
}

} // namespace

TEST(MedialVoxelSurfaceTopology, OffsetsFollowFromTheNumbersOfEdges)
{
  for (unsigned int edge = 0; edge < Topology::NumberOfEdges; ++edge)
  {
    const unsigned int axis = Topology::AxisOf(edge);
    const auto &       offset = Topology::OffsetOf(edge);
    EXPECT_EQ(offset[axis], 0);
    EXPECT_EQ(Topology::EdgeOf(axis,
                               static_cast<unsigned int>(offset[(axis + 1) % 3]),
                               static_cast<unsigned int>(offset[(axis + 2) % 3])),
              edge);
  }
}

TEST(MedialVoxelSurfaceTopology, FacesOfCrossedEdgesAreAmbiguous)
{
  for (unsigned int mask = 0; mask < NumberOfMasks; ++mask)
  {
    const unsigned int directions = Topology::AmbiguousDirections(static_cast<Topology::EdgeMask>(mask));
    for (unsigned int direction = 0; direction < Topology::NumberOfDirections; ++direction)
    {
      const unsigned int face = Topology::EdgesTowards(direction);
      ASSERT_EQ((directions >> direction & 1) != 0, (mask & face) == face) << mask << ' ' << direction;
    }
  }
}

TEST(MedialVoxelSurfaceTopology, SharedQuadrilateralsAreMirrored)
{
  std::mt19937                                random(812);
  std::uniform_int_distribution<unsigned int> masks(0, NumberOfMasks - 1);
  for (int round = 0; round < 20000; ++round)
  {
    const unsigned int quads = masks(random);
    const unsigned int behind = masks(random);
    const unsigned int direction = static_cast<unsigned int>(round) % Topology::NumberOfDirections;
    unsigned int       expected = 0;
    unsigned int       mirrored = 0;
    for (unsigned int edge = 0; edge < Topology::NumberOfEdges; ++edge)
    {
      if (HasEdge(quads & Topology::EdgesTowards(direction), edge))
      {
        mirrored |= 1u << Topology::Mirrored(edge, direction);
        expected += HasEdge(behind, Topology::Mirrored(edge, direction)) ? 1 : 0;
      }
    }
    const auto mask = static_cast<Topology::EdgeMask>(quads);
    ASSERT_EQ(Topology::MirroredEdges(mask, direction), mirrored);
    ASSERT_EQ(Topology::QuadsBetween(mask, static_cast<Topology::EdgeMask>(behind), direction), expected);
  }
}

TEST(MedialVoxelSurfaceTopology, FirstPartIsConnected)
{
  for (unsigned int mask = 0; mask < NumberOfMasks; ++mask)
  {
    ASSERT_EQ(Topology::FirstPart(static_cast<Topology::EdgeMask>(mask), 0), PartOfLowest(mask)) << mask;
  }
}
