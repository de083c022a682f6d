// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceBranches.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

namespace itk
{

namespace
{

using PointType = MedialVoxelSurfaceFaces::PointType;

constexpr std::uint64_t Most = std::numeric_limits<std::uint32_t>::max();

float
DistanceOf(const PointType & a, const PointType & b)
{
  double sum = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double difference = a[axis] - b[axis];
    sum += difference * difference;
  }
  return static_cast<float>(std::sqrt(sum));
}

} // namespace

auto
MedialVoxelSurfaceBranches::SideOf(const VerticesType & vertices, const unsigned int number) -> SideType
{
  return std::minmax(static_cast<IndexType>(vertices[number]), static_cast<IndexType>(vertices[(number + 1) % 4]));
}

MedialVoxelSurfaceFaces::~MedialVoxelSurfaceFaces() = default;

std::uint64_t
MedialVoxelSurfaceBranches::GetBytes(const std::uint64_t vertices,
                                     const std::uint64_t faces,
                                     const std::uint64_t junctionSides)
{
  // The sides are sorted by sheet in a second table.
  return vertices * (sizeof(IndexType) + 1) + faces * (sizeof(IndexType) + sizeof(Marks) + 1) + junctionSides * 2 * 24;
}

void
MedialVoxelSurfaceBranches::AddVertices(const std::uint64_t number)
{
  if (number > Most - m_NumberOfVertices)
  {
    throw std::length_error("The medial surface has more than 4294967295 vertices, too many to find its branches.");
  }
  m_NumberOfVertices += number;
}

void
MedialVoxelSurfaceBranches::AddFace(const VerticesType & vertices, const Marks & marks)
{
  if (m_Marks.size() == Most)
  {
    throw std::length_error("The medial surface has more than 4294967295 faces, too many to find its branches.");
  }
  const auto face = static_cast<IndexType>(m_Marks.size());
  m_Marks.push_back(marks);
  for (unsigned int number = 0; number < 4; ++number)
  {
    if ((marks.junctionSides >> number & 1u) != 0)
    {
      m_Junctions.push_back({ SideOf(vertices, number), face, static_cast<std::uint8_t>(number) });
    }
  }
}

void
MedialVoxelSurfaceBranches::Find(const double length, const MedialVoxelSurfaceFaces & faces)
{
  this->JoinSheets(faces);
  {
    std::vector<float> distances(static_cast<std::size_t>(m_NumberOfVertices), std::numeric_limits<float>::infinity());
    this->MeasureDistances(static_cast<float>(length), faces, distances);
    this->CollectFlags(distances, faces);
  }
  this->MarkBridges();
  this->MarkBranches();
  this->CountKeptFaces();
  this->NumberVertices(faces);
}

/** Sorts the junctions by side. */
std::vector<bool>
MedialVoxelSurfaceBranches::FindEndsOfJunctions()
{
  std::sort(m_Junctions.begin(), m_Junctions.end(), [](const JunctionSide & a, const JunctionSide & b) {
    return a.side < b.side;
  });
  std::vector<bool> isEnd(static_cast<std::size_t>(m_NumberOfVertices), false);
  std::vector<bool> isInside(isEnd.size(), false);
  for (std::size_t i = 0; i < m_Junctions.size(); ++i)
  {
    const SideType & side = m_Junctions[i].side;
    if (i > 0 && m_Junctions[i - 1].side == side)
    {
      continue;
    }
    for (const IndexType vertex : { side.first, side.second })
    {
      isInside[vertex] = isInside[vertex] || isEnd[vertex];
      isEnd[vertex] = !isInside[vertex];
    }
  }
  return isEnd;
}

/** Join faces that share a side, as soon as the second one comes. */
void
MedialVoxelSurfaceBranches::JoinSheets(const MedialVoxelSurfaceFaces & faces)
{
  const std::vector<bool>                           isEnd = this->FindEndsOfJunctions();
  std::unordered_map<SideType, IndexType, SideHash> open; // sides of which one face has come
  m_Flags.assign(m_Marks.size(), 0);
  m_Sheets = MedialVoxelDisjointSets<IndexType>(static_cast<IndexType>(m_Marks.size()));
  IndexType face = 0;
  faces.ForEachFace(false, [&](const VerticesType & vertices, const std::array<PointType, 4> &) {
    const Marks & marks = m_Marks[face];
    for (unsigned int number = 0; number < 4; ++number)
    {
      const SideType side = SideOf(vertices, number);
      if (((marks.rimSides | marks.junctionSides) >> number & 1) != 0)
      {
        continue;
      }
      if (isEnd[side.first] || isEnd[side.second])
      {
        m_EndSides.push_back({ side, face, static_cast<std::uint8_t>(number) });
        m_Flags[face] = IsBesideEnd;
        continue;
      }
      const auto [other, isNew] = open.emplace(side, face);
      if (!isNew)
      {
        m_Sheets.Join(face, other->second);
        open.erase(other);
      }
    }
    ++face;
  });
}

/** Distances below the length; the others stay infinite. The shortest sums do not depend on the order of the faces, so
 * sweeps to and fro until nothing changes need no queue. */
void
MedialVoxelSurfaceBranches::MeasureDistances(const float                     length,
                                             const MedialVoxelSurfaceFaces & faces,
                                             std::vector<float> &            distances) const
{
  for (const JunctionSide & junction : m_Junctions)
  {
    distances[junction.side.first] = 0.0f;
    distances[junction.side.second] = 0.0f;
  }
  bool isChanged = !m_Junctions.empty();
  for (bool backwards = false; isChanged; backwards = !backwards)
  {
    isChanged = false;
    faces.ForEachFace(backwards, [&](const VerticesType & vertices, const std::array<PointType, 4> & points) {
      for (unsigned int pair = 0; pair < 6; ++pair)
      {
        const unsigned int from = pair < 4 ? pair : pair - 4;
        const unsigned int to = pair < 4 ? (pair + 1) % 4 : pair - 2;
        float &            a = distances[vertices[from]];
        float &            b = distances[vertices[to]];
        if (std::min(a, b) < length)
        {
          const float apart = DistanceOf(points[from], points[to]);
          float &     farther = a < b ? b : a;
          const float sum = std::min(a, b) + apart;
          if (sum < farther && sum < length)
          {
            farther = sum;
            isChanged = true;
          }
        }
      }
    });
  }
}

/** Gather the flags of the faces of a sheet at its root. */
void
MedialVoxelSurfaceBranches::CollectFlags(const std::vector<float> & distances, const MedialVoxelSurfaceFaces & faces)
{
  IndexType face = 0;
  faces.ForEachFace(false, [&](const VerticesType & vertices, const std::array<PointType, 4> &) {
    const bool isLong = std::any_of(
      vertices.begin(), vertices.end(), [&](const std::uint64_t vertex) { return std::isinf(distances[vertex]); });
    std::uint8_t & flags = m_Flags[m_Sheets.Find(face)];
    flags = static_cast<std::uint8_t>(flags | (isLong ? IsLong : 0) | (m_Marks[face].rimSides != 0 ? HasRim : 0) |
                                      (m_Marks[face].junctionSides != 0 ? HasJunction : 0));
    ++face;
  });
}

/** The short sheets between junctions that do not touch. */
void
MedialVoxelSurfaceBranches::MarkBridges()
{
  std::vector<std::pair<IndexType, SideType>> sides; // by sheet
  for (const JunctionSide & junction : m_Junctions)
  {
    const IndexType root = m_Sheets.Find(junction.face);
    if ((m_Flags[root] & (HasRim | IsLong)) == HasRim)
    {
      sides.emplace_back(root, junction.side);
    }
  }
  std::sort(sides.begin(), sides.end());
  for (auto begin = sides.begin(); begin != sides.end();)
  {
    const IndexType root = begin->first;
    const auto      end = std::find_if(begin, sides.end(), [=](const auto & side) { return side.first != root; });
    std::unordered_map<IndexType, IndexType> parents; // of vertices
    const auto                               rootOf = [&](IndexType vertex) {
      for (auto parent = parents.emplace(vertex, vertex).first; parent->second != vertex; parent = parents.find(vertex))
      {
        vertex = parent->second;
      }
      return vertex;
    };
    for (auto side = begin; side != end; ++side)
    {
      const SideType roots = std::minmax(rootOf(side->second.first), rootOf(side->second.second));
      parents[roots.second] = roots.first;
    }
    const IndexType first = rootOf(begin->second.first);
    if (std::any_of(begin, end, [&](const auto & side) { return rootOf(side.second.first) != first; }))
    {
      m_Flags[root] |= IsBridge;
    }
    begin = end;
  }
}

void
MedialVoxelSurfaceBranches::MarkBranches()
{
  MedialVoxelAbortChecker checker;
  for (std::size_t face = 0; face < m_Flags.size(); ++face)
  {
    checker.Count();
    const std::uint8_t sheet = m_Flags[m_Sheets.Find(static_cast<IndexType>(face))];
    if ((sheet & (HasRim | HasJunction | IsLong | IsBridge)) == (HasRim | HasJunction))
    {
      m_Flags[face] |= IsBranch;
    }
  }
}

void
MedialVoxelSurfaceBranches::CountKeptFaces()
{
  m_Junctions.insert(m_Junctions.end(), m_EndSides.begin(), m_EndSides.end());
  m_EndSides = {};
  std::sort(m_Junctions.begin(), m_Junctions.end(), [](const JunctionSide & a, const JunctionSide & b) {
    return a.side < b.side;
  });
  for (auto begin = m_Junctions.begin(); begin != m_Junctions.end();)
  {
    const auto end =
      std::find_if(begin, m_Junctions.end(), [=](const JunctionSide & other) { return other.side != begin->side; });
    const auto kept =
      std::count_if(begin, end, [this](const JunctionSide & junction) { return this->IsFaceKept(junction.face); });
    std::for_each(
      begin, end, [=](JunctionSide & junction) { junction.numberOfKeptFaces = static_cast<std::uint8_t>(kept); });
    begin = end;
  }
  std::sort(m_Junctions.begin(), m_Junctions.end(), [](const JunctionSide & a, const JunctionSide & b) {
    return std::tie(a.face, a.number) < std::tie(b.face, b.number);
  });
}

void
MedialVoxelSurfaceBranches::NumberVertices(const MedialVoxelSurfaceFaces & faces)
{
  m_Numbers.assign(static_cast<std::size_t>(m_NumberOfVertices), NoNumber);
  std::uint64_t face = 0;
  faces.ForEachFace(false, [&](const VerticesType & vertices, const std::array<PointType, 4> &) {
    if (this->IsFaceKept(face++))
    {
      for (const std::uint64_t vertex : vertices)
      {
        m_Numbers[vertex] = 0;
      }
    }
  });
  IndexType next = 0;
  for (IndexType & number : m_Numbers)
  {
    number = number == NoNumber ? NoNumber : next++;
  }
}

auto
MedialVoxelSurfaceBranches::GetMarks(const std::uint64_t face, const Marks & before) const -> Marks
{
  Marks marks{ before.rimSides, 0 };
  if (before.junctionSides != 0 || (m_Flags[face] & IsBesideEnd) != 0)
  {
    auto junction = std::lower_bound(
      m_Junctions.begin(), m_Junctions.end(), face, [](const JunctionSide & side, const std::uint64_t wanted) {
        return side.face < wanted;
      });
    for (; junction != m_Junctions.end() && junction->face == face; ++junction)
    {
      const auto bit = static_cast<std::uint8_t>(1u << junction->number);
      marks.rimSides = static_cast<std::uint8_t>(marks.rimSides | (junction->numberOfKeptFaces == 1 ? bit : 0));
      marks.junctionSides =
        static_cast<std::uint8_t>(marks.junctionSides | (junction->numberOfKeptFaces > 2 ? bit : 0));
    }
  }
  return marks;
}

} // end namespace itk
