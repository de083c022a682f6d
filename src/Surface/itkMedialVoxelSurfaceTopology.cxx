// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceTopology.h"

#include <vector>

namespace itk
{

auto
MedialVoxelSurfaceTopology::JoinedEdges(const unsigned int edge, const unsigned int direction, const Splits splits)
  -> EdgeMask
{
  const Split split = SplitOf(splits, direction);
  if (split == Unsplit)
  {
    return EdgesTowards(direction);
  }
  const auto         ring = RingTowards(direction);
  const unsigned int first = split == AroundUneven ? 0 : 1;
  const unsigned int pair = 1u << ring[first] | 1u << ring[first + 1];
  return static_cast<EdgeMask>((pair >> edge & 1u) != 0 ? pair : EdgesTowards(direction) & ~pair);
}

auto
MedialVoxelSurfaceTopology::FirstPart(const EdgeMask quads, const Splits splits) -> EdgeMask
{
  // Few cells have a face that is split.
  static const std::vector<EdgeMask> unsplit = [] {
    std::vector<EdgeMask> parts(std::size_t{ 1 } << NumberOfEdges);
    for (std::size_t mask = 0; mask < parts.size(); ++mask)
    {
      parts[mask] = FindFirstPart(static_cast<EdgeMask>(mask), 0);
    }
    return parts;
  }();
  return splits == 0 ? unsplit[quads] : FindFirstPart(quads, splits);
}

auto
MedialVoxelSurfaceTopology::FindFirstPart(const EdgeMask quads, const Splits splits) -> EdgeMask
{
  unsigned int part = 0;
  for (unsigned int open = quads & (~unsigned{ quads } + 1u); open != 0;)
  {
    const auto edge = static_cast<unsigned int>(MedialVoxelLowestBit(open));
    part |= 1u << edge;
    for (unsigned int direction = 0; direction < NumberOfDirections; ++direction)
    {
      if ((EdgesTowards(direction) >> edge & 1) != 0)
      {
        open |= JoinedEdges(edge, direction, splits) & quads;
      }
    }
    open &= ~part;
  }
  return static_cast<EdgeMask>(part);
}

std::uint16_t
MedialVoxelSurfaceTopology::NeighborsToFollow(
  const std::array<unsigned int, std::size_t{ 2 } * NumberOfDirections> & counts)
{
  unsigned int joined = 0;
  unsigned int rim = 0;
  unsigned int junction = 0;
  for (unsigned int neighbor = 0; neighbor < counts.size(); ++neighbor)
  {
    joined |= (counts[neighbor] > 0 ? 1u : 0u) << neighbor;
    rim |= (counts[neighbor] == 1 ? 1u : 0u) << neighbor;
    junction |= (counts[neighbor] > 2 ? 1u : 0u) << neighbor;
  }
  if (rim != 0 && junction != 0)
  {
    return 0;
  }
  return static_cast<std::uint16_t>(rim != 0 ? rim : (junction != 0 ? junction : joined));
}

std::uint8_t
MedialVoxelSurfaceTopology::DirectionsToFollow(const EdgeMask quads)
{
  std::array<unsigned int, std::size_t{ 2 } * NumberOfDirections> counts{};
  for (unsigned int direction = 0; direction < NumberOfDirections; ++direction)
  {
    counts[direction] = QuadsTowards(quads, direction);
  }
  return static_cast<std::uint8_t>(NeighborsToFollow(counts));
}

} // end namespace itk
