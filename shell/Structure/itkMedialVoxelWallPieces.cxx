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

/** Area of the smallest wall, in squares of the radius. */
constexpr double SmallestCore = 1.0;

/** Walls whose angle has a smaller cosine go straight on: they turn by less than 45 degrees. */
constexpr double StraightCosine = -0.70710678118654752;

/** Share of the sheet around a node from which on a wall counts there, and how far around it, in radii. */
constexpr double LeastShare = 1.0 / 12.0;
constexpr double RadiusOfShare = 0.5;

/** A wall has its direction where the seam, which is round, is behind: between these radii around a node. */
constexpr double RadiusOfNear = 0.75;
constexpr double RadiusOfDirection = 1.5;

/** \class NearWall
 * \brief A wall around a node of a seam; places are from that node. */
class NearWall
{
public:
  void
  Add(const Point & place, const double distance, const double area)
  {
    (distance <= RadiusOfNear ? m_Near : m_Far).Add(place, area);
    m_Share += distance <= RadiusOfShare ? area : 0.0;
  }

  double
  GetShare() const
  {
    return m_Share;
  }

  /** Of its plane, away from the seam and at right angles to it. */
  Point
  GetDirection(const Point & seam) const
  {
    const Point away =
      m_Far.GetWeight() > 0.0 ? MedialVoxelSubtract(m_Far.GetMiddle(), m_Near.GetMiddle()) : m_Near.GetMiddle();
    const Point  along = MedialVoxelCross(seam, m_Far.FindAxes().directions[0]);
    const double sine = MedialVoxelNorm(along);
    if (sine < 0.5)
    {
      return MedialVoxelAddScaled(away, seam, -MedialVoxelDot(away, seam));
    }
    return MedialVoxelAddScaled({}, along, MedialVoxelDot(along, away) < 0.0 ? -1.0 : 1.0);
  }

private:
  double            m_Share{ 0 };
  MedialVoxelSpread m_Near;
  MedialVoxelSpread m_Far;
};

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
  // Without its outline, no core leaks through a gap of a seam that noise has left.
  std::vector<std::uint8_t> isCore(count);
  MedialVoxelDisjointSets   cores(count);
  MedialVoxelDisjointSets   parts(count);
  for (Index node = 0; node < count; ++node)
  {
    isCore[node] = isFlat[node];
    m_Graph.ForEachNeighbor(node, [&](const Index other) {
      parts.Join(node, other);
      isCore[node] = isFlat[other] == 0 ? 0 : isCore[node];
    });
  }
  for (Index node = 0; node < count; ++node)
  {
    m_Graph.ForEachNeighbor(node, [&](const Index other) {
      if (isCore[node] != 0 && isCore[other] != 0)
      {
        cores.Join(node, other);
      }
    });
  }
  std::vector<double> coreSizes(count); // in squares of the radius
  std::vector<double> partSizes(count);
  for (Index node = 0; node < count; ++node)
  {
    const double radius = m_Graph.GetRadius(node);
    const double size = m_Graph.GetArea(node) / (radius * radius);
    coreSizes[cores.Find(node)] += isCore[node] != 0 ? size : 0.0;
    partSizes[parts.Find(node)] += size;
  }
  std::vector<std::uint8_t> hasCore(count);
  for (Index node = 0; node < count; ++node)
  {
    if (isCore[node] != 0 && coreSizes[cores.Find(node)] >= SmallestCore)
    {
      hasCore[parts.Find(node)] = 1;
      m_Walls[node] = cores.Find(node);
    }
  }
  for (Index node = 0; node < count; ++node)
  {
    const Index part = parts.Find(node);
    if (hasCore[part] == 0 && partSizes[part] >= SmallestCore)
    {
      m_Walls[node] = part;
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
    if (this->IsContact(node))
    {
      nodes.push_back(node);
    }
  }
  m_Contacts.assign(nodes.size(), {});
  this->ForEachIndex(nodes.size(), [&](const std::size_t k, MedialVoxelSheetDisk & disk) {
    m_Contacts[k] = this->Describe(nodes[k], disk.Find(nodes[k], RadiusOfDirection * m_Graph.GetRadius(nodes[k])));
  });
}

bool
MedialVoxelWallPieces::IsContact(const Index node) const
{
  bool touches = false;
  m_Graph.ForEachNeighbor(node, [&](const Index other) { touches = touches || m_Walls[other] != m_Walls[node]; });
  return touches;
}

MedialVoxelWallPieces::Contact
MedialVoxelWallPieces::Describe(const Index node, const std::vector<Index> & disk) const
{
  std::map<Index, NearWall> walls;
  MedialVoxelSpread         seam;
  const double              radius = m_Graph.GetRadius(node);
  double                    area = 0.0;
  for (const Index other : disk)
  {
    const Point  place = MedialVoxelSubtract(m_Graph.GetPlace(other), m_Graph.GetPlace(node));
    const double distance = MedialVoxelNorm(place) / radius;
    const double weight = m_Graph.GetArea(other);
    walls[m_Walls[other]].Add(place, distance, weight);
    area += distance <= RadiusOfShare ? weight : 0.0;
    if (this->IsContact(other))
    {
      seam.Add(place, weight);
    }
  }
  Contact            contact{ node, {}, {} };
  std::vector<Point> directions;
  for (const auto & [wall, near] : walls)
  {
    if (near.GetShare() >= LeastShare * area)
    {
      contact.walls.push_back(wall);
      directions.push_back(near.GetDirection(seam.FindAxes().directions[2]));
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
    wall = wall == None ? None : joined.Find(wall);
  }
  return joins;
}

} // end namespace itk
