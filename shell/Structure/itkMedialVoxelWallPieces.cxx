// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallPieces.h"

#include "itkMedialVoxelDisjointSets.h"
#include "itkMedialVoxelSpread.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace itk
{
namespace
{

using Index = MedialVoxelSheetGraph::Index;
using Point = MedialVoxelVector3;

constexpr Index None = MedialVoxelSheetGraph::None;

/** Distance from a plane, in radii, above which the sheet around a node is of a seam. */
constexpr double FlatWithin = 0.12;

/** Area of the smallest wall, in squares of the radius: that of a square of a thickness. */
constexpr double SmallestCore = 0.45;

/** Walls whose angle has a smaller cosine go straight on: they turn by less than 45 degrees. */
constexpr double StraightCosine = -0.70710678118654752;

/** Share of the sheet around a node from which on a wall counts there, and how far around it, in radii. */
constexpr double LeastShare = 1.0 / 12.0;
constexpr double RadiusOfShare = 0.5;

/** The direction of a wall is that from its part near a node to its part around that, within these radii. */
constexpr double RadiusOfNear = 0.75;
constexpr double RadiusOfDirection = 1.5;

} // namespace

MedialVoxelWallPieces::MedialVoxelWallPieces(const MedialVoxelSheetGraph & graph, const MedialVoxelRunTasks & runTasks)
  : m_Graph(graph)
  , m_RunTasks(runTasks)
  , m_Walls(graph.GetNumberOfNodes(), None)
{
  this->FindCores();
  this->Grow();
  do
  {
    this->FindContacts();
  } while (this->JoinStraightOnes());
}

template <typename TFunction>
void
MedialVoxelWallPieces::ForEachIndex(const std::size_t count, TFunction && function) const
{
  constexpr std::size_t tasks = 16; // a disk has memory for all nodes
  m_RunTasks(tasks, [&](const std::size_t task, const std::function<void()> & check) {
    MedialVoxelSheetDisk disk(m_Graph);
    for (std::size_t k = task * count / tasks; k < (task + 1) * count / tasks; ++k)
    {
      check();
      function(static_cast<Index>(k), disk);
    }
  });
}

void
MedialVoxelWallPieces::FindCores()
{
  const Index               count = m_Graph.GetNumberOfNodes();
  std::vector<std::uint8_t> isFlat(count);
  this->ForEachIndex(count, [&](const Index node, MedialVoxelSheetDisk & disk) {
    const double      radius = m_Graph.GetRadius(node);
    MedialVoxelSpread spread(m_Graph.GetPlace(node));
    for (const Index other : disk.Find(node, radius))
    {
      spread.Add(m_Graph.GetPlace(other), m_Graph.GetArea(other));
    }
    isFlat[node] = spread.IsWithin(FlatWithin * radius) ? 1 : 0;
  });
  MedialVoxelDisjointSets cores(count);
  MedialVoxelDisjointSets parts(count);
  for (Index node = 0; node < count; ++node)
  {
    m_Graph.ForEachNeighbor(node, [&](const Index other) {
      parts.Join(node, other);
      if (isFlat[node] != 0 && isFlat[other] != 0)
      {
        cores.Join(node, other);
      }
    });
  }
  std::vector<double> sizes(count); // of cores, in squares of the radius
  for (Index node = 0; node < count; ++node)
  {
    const double radius = m_Graph.GetRadius(node);
    sizes[cores.Find(node)] += isFlat[node] != 0 ? m_Graph.GetArea(node) / (radius * radius) : 0.0;
  }
  std::vector<std::uint8_t> hasCore(count);
  const auto                isCore = [&](const Index node) { return sizes[cores.Find(node)] >= SmallestCore; };
  for (Index node = 0; node < count; ++node)
  {
    if (isFlat[node] != 0 && isCore(node))
    {
      hasCore[parts.Find(node)] = 1;
      m_Walls[node] = cores.Find(node);
    }
  }
  for (Index node = 0; node < count; ++node)
  {
    if (hasCore[parts.Find(node)] == 0)
    {
      m_Walls[node] = parts.Find(node);
    }
  }
}

/** Gives nodes of seams to the wall that is nearest along the sheet. */
void
MedialVoxelWallPieces::Grow()
{
  using Entry = std::tuple<double, Index, Index>; // distance, wall, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto                                                     spread = [&](const Index node, const double distance) {
    m_Graph.ForEachNeighbor(node, [&](const Index other) {
      if (m_Walls[other] == None)
      {
        const double step = MedialVoxelNorm(MedialVoxelSubtract(m_Graph.GetPlace(node), m_Graph.GetPlace(other)));
        queue.emplace(distance + step, m_Walls[node], other);
      }
    });
  };
  std::vector<Index> cores;
  for (Index node = 0; node < m_Walls.size(); ++node)
  {
    if (m_Walls[node] != None)
    {
      cores.push_back(node);
    }
  }
  for (const Index node : cores)
  {
    spread(node, 0.0);
  }
  while (!queue.empty())
  {
    const auto [distance, wall, node] = queue.top();
    queue.pop();
    if (m_Walls[node] == None)
    {
      m_Walls[node] = wall;
      spread(node, distance);
    }
  }
}

void
MedialVoxelWallPieces::FindContacts()
{
  std::vector<Index> nodes;
  for (Index node = 0; node < m_Walls.size(); ++node)
  {
    bool touches = false;
    m_Graph.ForEachNeighbor(node, [&](const Index other) { touches = touches || m_Walls[other] != m_Walls[node]; });
    if (touches)
    {
      nodes.push_back(node);
    }
  }
  m_Contacts.assign(nodes.size(), {});
  this->ForEachIndex(nodes.size(), [&](const std::size_t k, MedialVoxelSheetDisk & disk) {
    m_Contacts[k] = this->Describe(nodes[k], disk.Find(nodes[k], RadiusOfDirection * m_Graph.GetRadius(nodes[k])));
  });
}

MedialVoxelWallPieces::Contact
MedialVoxelWallPieces::Describe(const Index node, const std::vector<Index> & disk) const
{
  struct Share
  {
    double            area{ 0 };
    MedialVoxelSpread near;
    MedialVoxelSpread far;
  };
  std::map<Index, Share> shares;
  const double           radius = m_Graph.GetRadius(node);
  double                 area = 0.0;
  for (const Index other : disk)
  {
    const Point  offset = MedialVoxelSubtract(m_Graph.GetPlace(other), m_Graph.GetPlace(node));
    const double distance = MedialVoxelNorm(offset) / radius;
    const double weight = m_Graph.GetArea(other);
    Share &      share = shares[m_Walls[other]];
    (distance <= RadiusOfNear ? share.near : share.far).Add(offset, weight);
    share.area += distance <= RadiusOfShare ? weight : 0.0;
    area += distance <= RadiusOfShare ? weight : 0.0;
  }
  Contact            contact{ node, {}, {} };
  std::vector<Point> directions;
  for (const auto & [wall, share] : shares)
  {
    if (share.area >= LeastShare * area)
    {
      const bool reaches = share.far.GetWeight() > 0.0;
      contact.walls.push_back(wall);
      directions.push_back(reaches ? MedialVoxelSubtract(share.far.GetMiddle(), share.near.GetMiddle())
                                   : share.near.GetMiddle());
    }
  }
  for (std::size_t first = 0; first < directions.size(); ++first)
  {
    for (std::size_t second = first + 1; second < directions.size(); ++second)
    {
      contact.cosines.push_back(MedialVoxelCosine(directions[first], directions[second]));
    }
  }
  return contact;
}

bool
MedialVoxelWallPieces::JoinStraightOnes()
{
  struct Meeting
  {
    Index  contacts{ 0 };
    Index  withThird{ 0 };
    double cosines{ 0 };
  };
  std::map<std::pair<Index, Index>, Meeting> meetings;
  for (const Contact & contact : m_Contacts)
  {
    std::size_t pair = 0;
    for (std::size_t first = 0; first < contact.walls.size(); ++first)
    {
      for (std::size_t second = first + 1; second < contact.walls.size(); ++second)
      {
        Meeting & meeting = meetings[{ contact.walls[first], contact.walls[second] }];
        ++meeting.contacts;
        meeting.withThird += contact.walls.size() > 2 ? 1 : 0;
        meeting.cosines += contact.cosines[pair++];
      }
    }
  }
  MedialVoxelDisjointSets joined(m_Graph.GetNumberOfNodes());
  bool                    joins = false;
  for (const auto & [walls, meeting] : meetings)
  {
    if (2 * meeting.withThird < meeting.contacts && meeting.cosines < StraightCosine * meeting.contacts)
    {
      joined.Join(walls.first, walls.second);
      joins = true;
    }
  }
  for (Index & wall : m_Walls)
  {
    wall = joined.Find(wall);
  }
  return joins;
}

} // end namespace itk
