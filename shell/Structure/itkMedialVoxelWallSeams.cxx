// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallSeams.h"

#include "itkMedialVoxelDisjointSets.h"
#include "itkMedialVoxelElementary.h"
#include "itkMedialVoxelSpread.h"

#include <algorithm>
#include <limits>
#include <map>

namespace itk
{
namespace
{

using Index = MedialVoxelSheetGraph::Index;
using Set = MedialVoxelWallPieces::Set;
using Point = MedialVoxelVector3;

/** Walls that meet no farther from their middle than so many radii meet in a point. */
constexpr double RadiiOfPoint = 1.0;

/** So far from each other contacts are of one line. */
constexpr double RadiiOfLine = 0.5;

constexpr double DegreesPerRadian = 57.295779513082321;

/** \class Seams
 * \brief Gives the contacts of walls to seams. */
class Seams
{
public:
  Seams(const MedialVoxelSheetGraph & graph, const std::vector<MedialVoxelWallPieces::Contact> & contacts)
    : m_Graph(graph)
    , m_Contacts(contacts)
    , m_ContactOf(graph.GetNumberOfNodes(), MedialVoxelSheetGraph::None)
  {
    for (Index contact = 0; contact < contacts.size(); ++contact)
    {
      m_ContactOf[contacts[contact].node] = contact;
    }
  }

  /** Of each contact, its walls along a line; the nearest ones at points where lines meet. */
  std::vector<Set>
  FindLines() const
  {
    const auto              count = static_cast<Index>(m_Contacts.size());
    MedialVoxelDisjointSets lines(count);
    for (Index contact = 0; contact < count; ++contact)
    {
      this->ForEachNeighbor(contact, [&](const Index other) {
        if (m_Contacts[other].walls == m_Contacts[contact].walls)
        {
          lines.Join(contact, other);
        }
      });
    }
    const std::vector<bool> isPoint = this->FindPoints(lines);
    std::vector<Set>        sets(count);
    std::vector<Index>      front;
    std::vector<bool>       isOfLine(count);
    for (Index contact = 0; contact < count; ++contact)
    {
      if (m_Contacts[contact].walls.size() > 1 && !isPoint[lines.Find(contact)])
      {
        isOfLine[contact] = true;
        front.push_back(contact);
      }
    }
    MedialVoxelSheetDisk disk(m_Graph);
    for (const Index contact : front)
    {
      sets[contact] = this->FindLargestSet(contact, isOfLine, disk);
    }
    this->Spread(std::move(front), sets);
    for (Index contact = 0; contact < count; ++contact)
    {
      if (sets[contact].empty() && m_Contacts[contact].walls.size() > 1)
      {
        sets[contact] = m_Contacts[contact].walls; // no line is near
      }
    }
    return sets;
  }

private:
  template <typename TFunction>
  void
  ForEachNeighbor(const Index contact, TFunction && function) const
  {
    m_Graph.ForEachNeighbor(m_Contacts[contact].node, [&](const Index node) {
      if (m_ContactOf[node] != MedialVoxelSheetGraph::None)
      {
        function(m_ContactOf[node]);
      }
    });
  }

  /** Whether the line of a contact, by the first one of it, is a point. */
  std::vector<bool>
  FindPoints(MedialVoxelDisjointSets<Index> & lines) const
  {
    const auto                     count = static_cast<Index>(m_Contacts.size());
    std::vector<MedialVoxelSpread> spreads(count);
    std::vector<bool>              isPoint(count, true);
    for (Index contact = 0; contact < count; ++contact)
    {
      spreads[lines.Find(contact)].Add(m_Graph.GetPlace(m_Contacts[contact].node), 1.0);
    }
    for (Index contact = 0; contact < count; ++contact)
    {
      const Index  line = lines.Find(contact);
      const Index  node = m_Contacts[contact].node;
      const Point  offset = MedialVoxelSubtract(m_Graph.GetPlace(node), spreads[line].GetMiddle());
      const double limit = RadiiOfPoint * m_Graph.GetRadius(node);
      isPoint[line] = isPoint[line] && MedialVoxelDot(offset, offset) <= limit * limit;
    }
    return isPoint;
  }

  /** The walls of a contact, or more that meet on a line beside it: at a slanted wall those on the one side are few. */
  const Set &
  FindLargestSet(const Index contact, const std::vector<bool> & isOfLine, MedialVoxelSheetDisk & disk) const
  {
    const Index node = m_Contacts[contact].node;
    const Set * largest = &m_Contacts[contact].walls;
    for (const Index other : disk.Find(node, RadiiOfLine * m_Graph.GetRadius(node)))
    {
      const Index beside = m_ContactOf[other];
      if (beside != MedialVoxelSheetGraph::None && isOfLine[beside])
      {
        const Set & walls = m_Contacts[beside].walls;
        const bool  isMore = walls.size() > largest->size();
        largest =
          isMore && std::includes(walls.begin(), walls.end(), largest->begin(), largest->end()) ? &walls : largest;
      }
    }
    return *largest;
  }

  void
  Spread(std::vector<Index> front, std::vector<Set> & sets) const
  {
    while (!front.empty())
    {
      std::map<Index, Set> next;
      for (const Index contact : front)
      {
        this->ForEachNeighbor(contact, [&](const Index other) {
          if (sets[other].empty())
          {
            next.emplace(other, sets[contact]);
          }
        });
      }
      front.clear();
      for (auto & [contact, walls] : next)
      {
        sets[contact] = std::move(walls);
        front.push_back(contact);
      }
    }
  }

  const MedialVoxelSheetGraph &                       m_Graph;
  const std::vector<MedialVoxelWallPieces::Contact> & m_Contacts;
  std::vector<Index>                                  m_ContactOf;
};

/** The length of the curve that points lie along: each has the length of its piece, shared with all points there. */
double
MeasureLength(const std::vector<Point> & points, const double radius)
{
  using Cube = std::array<std::int64_t, 3>;
  const auto cubeOf = [radius](const Point & point) {
    return Cube{
      { MedialVoxelFloor(point[0] / radius), MedialVoxelFloor(point[1] / radius), MedialVoxelFloor(point[2] / radius) }
    };
  };
  std::map<Cube, std::vector<Point>> cubes;
  for (const Point & point : points)
  {
    cubes[cubeOf(point)].push_back(point);
  }
  double length = 0.0;
  for (const Point & point : points)
  {
    const Cube        own = cubeOf(point);
    MedialVoxelSpread spread(point);
    for (unsigned int k = 0; k < 27; ++k)
    {
      const auto found = cubes.find({ { own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1 } });
      for (std::size_t i = 0; found != cubes.end() && i < found->second.size(); ++i)
      {
        const Point offset = MedialVoxelSubtract(found->second[i], point);
        if (MedialVoxelDot(offset, offset) <= radius * radius)
        {
          spread.Add(found->second[i], 1.0);
        }
      }
    }
    // The variance of a segment is a twelfth of the square of its length.
    length += std::sqrt(12.0 * spread.FindAxes().variances[2]) / spread.GetWeight();
  }
  return length;
}

} // namespace

std::vector<MedialVoxelSeamRow>
MedialVoxelFindSeams(const MedialVoxelSheetGraph & graph,
                     const MedialVoxelWallPieces & pieces,
                     const std::vector<Index> &    numberOf)
{
  struct Line
  {
    std::vector<Point>                                          points;
    double                                                      radii{ 0 };
    std::map<std::pair<Index, Index>, std::pair<double, Index>> angles; // sum and number
  };
  const auto &           contacts = pieces.GetContacts();
  const std::vector<Set> sets = Seams(graph, contacts).FindLines();
  std::map<Set, Line>    lines;
  for (std::size_t number = 0; number < contacts.size(); ++number)
  {
    const auto & contact = contacts[number];
    if (sets[number].empty())
    {
      continue;
    }
    Set walls;
    for (const Index wall : sets[number])
    {
      walls.push_back(numberOf[wall]);
    }
    std::sort(walls.begin(), walls.end());
    Line & line = lines[walls];
    line.points.push_back(graph.GetPlace(contact.node));
    line.radii += graph.GetRadius(contact.node);
    std::size_t pair = 0;
    for (std::size_t first = 0; first < contact.walls.size(); ++first)
    {
      for (std::size_t second = first + 1; second < contact.walls.size(); ++second)
      {
        auto & angle = line.angles[std::minmax(numberOf[contact.walls[first]], numberOf[contact.walls[second]])];
        angle.first += DegreesPerRadian * MedialVoxelElementary::ArcCosine(contact.cosines[pair++]);
        ++angle.second;
      }
    }
  }
  std::vector<MedialVoxelSeamRow> seams;
  for (const auto & [walls, line] : lines)
  {
    MedialVoxelSeamRow seam;
    seam.walls = walls;
    seam.length = MeasureLength(line.points, line.radii / static_cast<double>(line.points.size()));
    for (std::size_t first = 0; first < walls.size(); ++first)
    {
      for (std::size_t second = first + 1; second < walls.size(); ++second)
      {
        const auto found = line.angles.find({ walls[first], walls[second] });
        const bool isKnown = found != line.angles.end();
        seam.angles.push_back(isKnown ? found->second.first / found->second.second
                                      : std::numeric_limits<double>::quiet_NaN());
      }
    }
    seams.push_back(std::move(seam));
  }
  return seams;
}

} // end namespace itk
