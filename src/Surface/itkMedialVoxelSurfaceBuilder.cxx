// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceBuilder.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace itk
{

using Topology = MedialVoxelSurfaceTopology;

namespace
{

constexpr double TowardsNeighbors = 0.6;

constexpr std::uint32_t CellsHandedOnAtATime = 1u << 13;

/** Vertices of a slice up to which its memory is kept for the next one. */
constexpr std::size_t MostSpareVertices = std::size_t{ 1 } << 16;

/** That no plane with rational coefficients holds. */
constexpr std::array<double, 3> FrontDirection{ { 1.0, 1.4142135623730951, 1.7320508075688772 } };

using Vector = MedialVoxelVector3;

double
AreaOfTriangle(const Vector & a, const Vector & b, const Vector & c)
{
  const Vector normal = MedialVoxelCross(MedialVoxelSubtract(b, a), MedialVoxelSubtract(c, a));
  return 0.5 * MedialVoxelNorm(normal);
}

/** Order of the cells of a slice; one more along y is 2^32 more. */
std::int64_t
KeyOf(const MedialVoxelSurfaceCell & cell)
{
  return (std::int64_t{ cell.index[1] } << 32) + cell.index[0];
}

/** From a cell to its neighbor in a direction, as a difference of keys. */
std::int64_t
KeyStep(const unsigned int direction)
{
  const std::int64_t step = direction / 2 == 0 ? 1 : (direction / 2 == 1 ? std::int64_t{ 1 } << 32 : 0);
  return direction % 2 == 0 ? -step : step;
}

/** The vertex with an edge in the cell that has this key, from \a position on. */
std::uint32_t
FindVertex(const std::vector<MedialVoxelSurfaceCell> & cells,
           std::size_t                                 position,
           const std::int64_t                          key,
           const unsigned int                          edge)
{
  for (; position < cells.size() && KeyOf(cells[position]) == key; ++position)
  {
    if ((cells[position].quads >> edge & 1) != 0)
    {
      return static_cast<std::uint32_t>(position);
    }
  }
  throw std::logic_error("A cell of the medial surface lacks a neighbor.");
}

/** Topology::DirectionsToFollow() of all masks. */
const std::vector<std::uint8_t> &
DirectionsToFollow()
{
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> directions(std::size_t{ 1 } << Topology::NumberOfEdges);
    for (std::size_t mask = 0; mask < directions.size(); ++mask)
    {
      directions[mask] = Topology::DirectionsToFollow(static_cast<Topology::EdgeMask>(mask));
    }
    return directions;
  }();
  return table;
}

} // namespace

MedialVoxelSurfaceBuilder::MedialVoxelSurfaceBuilder(const MedialVoxelSurfacePlacement &  placement,
                                                     const MedialVoxelGrid::SpacingType & spacing,
                                                     MedialVoxelSurfaceConsumer &         consumer)
  : m_Placement(placement)
  , m_Spacing(spacing)
  , m_Consumer(consumer)
{}

void
MedialVoxelSurfaceBuilder::AddSlice(const std::int64_t z, std::vector<MedialVoxelSurfaceCell> cells)
{
  while (m_NextSlice < z)
  {
    this->Push({});
  }
  this->Push(std::move(cells));
}

void
MedialVoxelSurfaceBuilder::Finish()
{
  for (unsigned int step = 0; step < NumberOfSteps; ++step)
  {
    this->Push({});
  }
  m_Slices.clear();
}

/** Find the neighbors of vertices of \a from in a direction, which lie in \a to. */
void
MedialVoxelSurfaceBuilder::Link(Slice &                                     from,
                                const std::vector<MedialVoxelSurfaceCell> & to,
                                const unsigned int                          direction)
{
  MedialVoxelAbortChecker checker;
  std::size_t             position = 0;
  for (std::uint32_t i = 0; i < from.cells.size(); ++i)
  {
    checker.Count();
    // As they are numbered in the neighbor.
    const MedialVoxelSurfaceCell & cell = from.cells[i];
    const unsigned int             edges = Topology::MirroredEdges(cell.quads, direction);
    if (edges == 0)
    {
      continue;
    }
    const std::int64_t key = KeyOf(cell) + KeyStep(direction);
    while (position < to.size() && KeyOf(to[position]) < key)
    {
      ++position;
    }
    const std::uint32_t first = FindVertex(to, position, key, static_cast<unsigned int>(MedialVoxelLowestBit(edges)));
    from.neighbors[i][direction] = first;
    const auto others = static_cast<Topology::EdgeMask>(edges & ~unsigned{ to[first].quads });
    if (others != 0)
    {
      const auto edge = static_cast<unsigned int>(MedialVoxelLowestBit(others));
      from.secondNeighbors[SecondKeyOf(i, direction)] = { FindVertex(to, position, key, edge),
                                                          Topology::MirroredEdges(others, direction ^ 1u) };
    }
  }
}

std::uint32_t
MedialVoxelSurfaceBuilder::NeighborOf(const Slice &       slice,
                                      const std::uint32_t cell,
                                      const unsigned int  direction,
                                      const unsigned int  edge)
{
  const auto second = slice.secondNeighbors.find(SecondKeyOf(cell, direction));
  const bool isSecond = second != slice.secondNeighbors.end() && (second->second.edges >> edge & 1) != 0;
  return isSecond ? second->second.cell : slice.neighbors[cell][direction];
}

/** Topology::NeighborsToFollow(). */
std::uint16_t
MedialVoxelSurfaceBuilder::NeighborsToFollow(const Slice & slice, const std::uint32_t cell)
{
  const Topology::EdgeMask quads = slice.cells[cell].quads;
  const auto               seconds = slice.secondNeighbors.lower_bound(SecondKeyOf(cell, 0));
  if (seconds == slice.secondNeighbors.end() || seconds->first >= SecondKeyOf(cell + 1, 0))
  {
    return DirectionsToFollow()[quads];
  }
  std::array<unsigned int, std::size_t{ 2 } * NumberOfDirections> counts{};
  for (unsigned int direction = 0; direction < NumberOfDirections; ++direction)
  {
    const auto second = slice.secondNeighbors.find(SecondKeyOf(cell, direction));
    if (second != slice.secondNeighbors.end())
    {
      counts[direction + NumberOfDirections] = Topology::QuadsTowards(second->second.edges, direction);
    }
    counts[direction] = Topology::QuadsTowards(quads, direction) - counts[direction + NumberOfDirections];
  }
  return Topology::NeighborsToFollow(counts);
}

void
MedialVoxelSurfaceBuilder::FindNeighborsToFollow(Slice & slice)
{
  MedialVoxelAbortChecker checker;
  slice.followed.resize(slice.cells.size());
  for (std::uint32_t i = 0; i < slice.cells.size(); ++i)
  {
    checker.Count();
    slice.followed[i] = NeighborsToFollow(slice, i);
  }
}

auto
MedialVoxelSurfaceBuilder::AddEmptySlice() -> Slice &
{
  m_Slices.push_back(std::exchange(m_Spare, {}));
  Slice & slice = m_Slices.back();
  slice.secondNeighbors.clear();
  slice.offsets.clear();
  slice.points.clear();
  return slice;
}

/** Make the newest slice of cells, and join it with the one before, which then has all of its neighbors. */
void
MedialVoxelSurfaceBuilder::Append(std::vector<MedialVoxelSurfaceCell> cells)
{
  Slice & slice = this->AddEmptySlice();
  slice.firstVertex = m_NumberOfVertices;
  m_NumberOfVertices += cells.size();
  ++m_NextSlice;
  slice.neighbors.resize(cells.size());
  slice.offsets.reserve(cells.size());
  for (const MedialVoxelSurfaceCell & cell : cells)
  {
    slice.offsets.push_back(cell.offset);
  }
  slice.previous.resize(cells.size());
  slice.cells = std::move(cells);
  for (unsigned int direction = 0; direction < 4; ++direction)
  {
    Link(slice, slice.cells, direction);
  }
  if (m_Slices.size() > 1)
  {
    Slice & before = m_Slices[m_Slices.size() - 2];
    Link(slice, before.cells, 4);
    Link(before, slice.cells, 5);
    FindNeighborsToFollow(before);
  }
}

/** Append a slice, and move each of the ones before it one step on. */
void
MedialVoxelSurfaceBuilder::Push(std::vector<MedialVoxelSurfaceCell> cells)
{
  this->Append(std::move(cells));
  const std::size_t newest = m_Slices.size() - 1;
  for (std::size_t step = 1; step <= std::min<std::size_t>(newest, NumberOfSteps); ++step)
  {
    this->Smooth(newest - step);
  }
  if (newest >= NumberOfSteps)
  {
    this->HandOn(newest - NumberOfSteps);
  }
  // Quadrilaterals of a slice and its last step need the slice before it.
  if (newest > NumberOfSteps)
  {
    if (m_Slices.front().cells.size() <= MostSpareVertices)
    {
      m_Spare = std::move(m_Slices.front());
    }
    m_Slices.pop_front();
  }
}

/** Move the vertices of a slice one step on. The slice after it is one step behind the result, that before it is as
 * far as the result. */
void
MedialVoxelSurfaceBuilder::Smooth(const std::size_t at)
{
  Slice &         slice = m_Slices[at];
  const Offsets & own = slice.offsets;
  const Offsets & before = at > 0 ? m_Slices[at - 1].previous : own;
  const Offsets & after = m_Slices[at + 1].offsets;
  const Offsets * offsetsOf[NumberOfDirections] = { &own, &own, &own, &own, &before, &after };
  // Adding nothing along the other axes is faster than choosing one.
  Vector stepOf[NumberOfDirections]{};
  for (unsigned int direction = 0; direction < NumberOfDirections; ++direction)
  {
    const unsigned int axis = direction / 2;
    stepOf[direction][axis] = direction % 2 == 0 ? -m_Spacing[axis] : m_Spacing[axis];
  }
  MedialVoxelAbortChecker checker;
  for (std::uint32_t i = 0; i < slice.cells.size(); ++i)
  {
    checker.Count();
    const MedialVoxelSurfaceCell & cell = slice.cells[i];
    Vector                         sum{};
    double                         number = 0.0;
    for (unsigned int rest = slice.followed[i]; rest != 0; rest &= rest - 1)
    {
      const auto         neighborNumber = static_cast<unsigned int>(MedialVoxelLowestBit(rest));
      const unsigned int direction = neighborNumber % NumberOfDirections;
      const auto &       neighbor = (*offsetsOf[direction])[neighborNumber < NumberOfDirections
                                                              ? slice.neighbors[i][direction]
                                                              : slice.secondNeighbors.at(SecondKeyOf(i, direction)).cell];
      const Vector &     step = stepOf[direction];
      for (unsigned int component = 0; component < 3; ++component)
      {
        sum[component] = (sum[component] + static_cast<double>(neighbor[component])) + step[component];
      }
      number += 1.0;
    }
    Vector offset{ { own[i][0], own[i][1], own[i][2] } };
    if (number > 0.0)
    {
      for (unsigned int component = 0; component < 3; ++component)
      {
        offset[component] += TowardsNeighbors * (sum[component] / number - offset[component]);
      }
    }
    const Vector normal{ { cell.normal[0], cell.normal[1], cell.normal[2] } };
    const double toPlane = m_WeightOfPlane * (static_cast<double>(cell.distance) - MedialVoxelDot(normal, offset));
    for (unsigned int component = 0; component < 3; ++component)
    {
      slice.previous[i][component] = static_cast<float>(offset[component] + toPlane * normal[component]);
    }
  }
  std::swap(slice.offsets, slice.previous);
}

void
MedialVoxelSurfaceBuilder::HandOn(const std::size_t at)
{
  Slice &      slice = m_Slices[at];
  const auto & cells = slice.cells;
  const auto   numberOfCells = static_cast<std::uint32_t>(cells.size());
  slice.points.reserve(numberOfCells);
  // A slice along a wall has many cells, whose results need not be in memory at the same time.
  for (std::uint32_t begin = 0; begin < numberOfCells;)
  {
    MedialVoxelCheckAbort();
    m_Vertices.clear();
    m_Quads.clear();
    while (begin < numberOfCells && m_Vertices.size() < CellsHandedOnAtATime)
    {
      // The vertices of a cell, whose faces follow each other by axes.
      std::uint32_t end = begin;
      unsigned int  quads = 0;
      for (; end < numberOfCells && KeyOf(cells[end]) == KeyOf(cells[begin]); ++end)
      {
        slice.points.push_back(this->PointOf(slice, end));
        m_Vertices.push_back({ slice.points.back(), static_cast<double>(cells[end].thickness), cells[end].part });
        quads |= cells[end].quads;
      }
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const unsigned int edge = Topology::EdgeOf(axis, 0, 0);
        for (std::uint32_t cell = begin; (quads >> edge & 1) != 0 && cell < end; ++cell)
        {
          if ((cells[cell].quads >> edge & 1) != 0)
          {
            m_Quads.push_back(this->MakeQuad(at, cell, axis));
          }
        }
      }
      begin = end;
    }
    m_Consumer.AddVertices(m_Vertices);
    m_Consumer.AddQuads(m_Quads);
  }
  // The next slice needs the step before, and the points.
  if (numberOfCells > MostSpareVertices)
  {
    Offsets().swap(slice.offsets);
    decltype(slice.followed)().swap(slice.followed);
  }
}

MedialVoxelSurfaceQuad
MedialVoxelSurfaceBuilder::MakeQuad(const std::size_t at, const std::uint32_t cell, const unsigned int axis) const
{
  const auto lowerOf = [&](const Corner & from, const unsigned int along, const unsigned int edge) -> Corner {
    return { along == 2 ? &m_Slices[at - 1] : from.slice, NeighborOf(*from.slice, from.cell, 2 * along, edge) };
  };
  const auto countBetween = [](const Corner & from, const Corner & to, const unsigned int along) {
    return Topology::QuadsBetween(from.GetCell().quads, to.GetCell().quads, 2 * along);
  };
  const unsigned int next = (axis + 1) % 3;
  const unsigned int afterNext = (axis + 2) % 3;
  // Numbers of the voxel edge in the cells.
  const unsigned int inUpper = Topology::EdgeOf(axis, 0, 0);
  const unsigned int inAlongNext = Topology::EdgeOf(axis, 0, 1);
  const Corner       upper{ &m_Slices[at], cell };
  const Corner       alongNext = lowerOf(upper, afterNext, inUpper);
  const Corner       alongAfterNext = lowerOf(upper, next, inUpper);
  const Corner       corners[4] = { lowerOf(alongNext, next, inAlongNext), alongNext, upper, alongAfterNext };
  const unsigned int meeting[4] = { countBetween(corners[1], corners[0], next),
                                    countBetween(corners[2], corners[1], afterNext),
                                    countBetween(corners[2], corners[3], next),
                                    countBetween(corners[3], corners[0], afterNext) };
  const Vector       points[4] = {
    corners[0].GetPoint(), corners[1].GetPoint(), corners[2].GetPoint(), corners[3].GetPoint()
  };

  const Vector           diagonal02 = MedialVoxelSubtract(points[2], points[0]);
  const Vector           diagonal13 = MedialVoxelSubtract(points[3], points[1]);
  const bool             isReversed = MedialVoxelDot(MedialVoxelCross(diagonal02, diagonal13), FrontDirection) < 0.0;
  MedialVoxelSurfaceQuad quad;
  for (unsigned int side = 0; side < 4; ++side)
  {
    const Corner &     corner = corners[isReversed ? (4 - side) % 4 : side];
    const unsigned int number = meeting[isReversed ? 3 - side : side];
    quad.vertices[side] = corner.slice->firstVertex + corner.cell;
    quad.rimSides = static_cast<std::uint8_t>(quad.rimSides | (number == 1 ? 1u << side : 0u));
    quad.junctionSides = static_cast<std::uint8_t>(quad.junctionSides | (number > 2 ? 1u << side : 0u));
  }
  quad.isSplitAlong13 = MedialVoxelDot(diagonal13, diagonal13) < MedialVoxelDot(diagonal02, diagonal02);
  for (unsigned int half = 0; half < 2; ++half)
  {
    Vector triangle[3];
    for (unsigned int i = 0; i < 3; ++i)
    {
      const unsigned int side = quad.GetTriangle(half)[i];
      triangle[i] = points[isReversed ? (4 - side) % 4 : side];
    }
    quad.areas[half] = AreaOfTriangle(triangle[0], triangle[1], triangle[2]);
  }
  return quad;
}

/** The physical point of a vertex. */
Vector
MedialVoxelSurfaceBuilder::PointOf(const Slice & slice, const std::uint32_t cell) const
{
  Vector point = m_Placement.origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double index = static_cast<double>(slice.cells[cell].index[axis]) + 0.5 +
                         static_cast<double>(slice.offsets[cell][axis]) / m_Spacing[axis];
    for (unsigned int component = 0; component < 3; ++component)
    {
      point[component] += index * m_Placement.steps[axis][component];
    }
  }
  return point;
}

} // end namespace itk
