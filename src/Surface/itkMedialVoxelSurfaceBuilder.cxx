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

/** Vertices of a part that is handed on, and such parts that are made together. */
constexpr std::uint32_t VerticesOfPart = 1u << 13;
constexpr std::size_t   PartsAtATime = MedialVoxelSurfaceBuilder::VerticesOfBatch / VerticesOfPart;

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
  this->DoBatch();
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

/** Make the newest slice of cells. */
void
MedialVoxelSurfaceBuilder::Push(std::vector<MedialVoxelSurfaceCell> cells)
{
  if (m_WaitingVertices + cells.size() > VerticesOfBatch)
  {
    this->DoBatch();
  }
  m_Slices.emplace_back();
  if (!m_Spare.empty())
  {
    m_Slices.back() = std::move(m_Spare.back());
    m_Spare.pop_back();
  }
  Slice & slice = m_Slices.back();
  slice.firstVertex = m_NumberOfVertices;
  slice.cells = std::move(cells);
  m_NumberOfVertices += slice.cells.size();
  m_WaitingVertices += slice.cells.size();
  ++m_NumberOfWaiting;
  ++m_NextSlice;
}

/** Join the slices that wait, and move each slice on by the steps that they allow. */
void
MedialVoxelSurfaceBuilder::DoBatch()
{
  const Range newSlices{ m_Slices.size() - m_NumberOfWaiting, m_Slices.size() };
  const auto  before = [&](const std::size_t number) {
    return Range{ newSlices.begin - std::min(newSlices.begin, number), newSlices.end - std::min(newSlices.end, number) };
  };
  this->ForEachSlice({ before(1).begin, newSlices.end }, [&](const std::size_t at) { this->Join(at, newSlices); });
  for (unsigned int step = 1; step <= NumberOfSteps; ++step)
  {
    const Range slices = before(step);
    this->ForEachSlice(slices, [&](const std::size_t at) { this->Smooth(at, slices); });
    std::for_each(m_Slices.begin() + static_cast<std::ptrdiff_t>(slices.begin),
                  m_Slices.begin() + static_cast<std::ptrdiff_t>(slices.end),
                  [](Slice & slice) { std::swap(slice.offsets, slice.previous); });
  }
  const Range done = before(NumberOfSteps);
  this->ForEachSlice(done, [&](const std::size_t at) { this->PlacePoints(at); });
  this->HandOn(done);
  // Quadrilaterals of a slice and its last step need the slice before it.
  for (std::size_t number = 1; number < done.end; ++number)
  {
    if (m_Slices.front().cells.size() <= MostSpareVertices)
    {
      m_Spare.push_back(std::move(m_Slices.front()));
    }
    m_Slices.pop_front();
  }
  m_NumberOfWaiting = 0;
  m_WaitingVertices = 0;
}

template <typename TTask>
void
MedialVoxelSurfaceBuilder::ForEachSlice(const Range & slices, TTask && task)
{
  if (slices.begin < slices.end)
  {
    m_RunTasks(slices.end - slices.begin, [&](const std::size_t number) { task(slices.begin + number); });
  }
}

void
MedialVoxelSurfaceBuilder::RunHere(const std::size_t count, const std::function<void(std::size_t number)> & task)
{
  for (std::size_t number = 0; number < count; ++number)
  {
    task(number);
  }
}

/** Find neighbors in a new slice and the one before it, and those in the slice after it, which is new. */
void
MedialVoxelSurfaceBuilder::Join(const std::size_t at, const Range & newSlices)
{
  Slice & slice = m_Slices[at];
  if (newSlices.Contains(at))
  {
    slice.secondNeighbors.clear();
    slice.points.clear();
    slice.neighbors.resize(slice.cells.size());
    slice.previous.resize(slice.cells.size());
    slice.offsets.resize(slice.cells.size());
    std::transform(slice.cells.begin(), slice.cells.end(), slice.offsets.begin(), [](const MedialVoxelSurfaceCell & cell) {
      return cell.offset;
    });
    for (unsigned int direction = 0; direction < 4; ++direction)
    {
      Link(slice, slice.cells, direction);
    }
    if (at > 0)
    {
      Link(slice, m_Slices[at - 1].cells, 4);
    }
  }
  if (newSlices.Contains(at + 1))
  {
    Link(slice, m_Slices[at + 1].cells, 5);
    FindNeighborsToFollow(slice);
  }
}

/** Move the vertices of a slice one step on, to its previous places. The slice after it is one step behind the result; the
 * one before it takes the step, too, or has taken it. */
void
MedialVoxelSurfaceBuilder::Smooth(const std::size_t at, const Range & slicesOfStep)
{
  Slice &         slice = m_Slices[at];
  const Offsets & own = slice.offsets;
  const Offsets & before = at == 0                             ? own
                           : slicesOfStep.Contains(at - 1) ? m_Slices[at - 1].offsets
                                                           : m_Slices[at - 1].previous;
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
}

void
MedialVoxelSurfaceBuilder::PlacePoints(const std::size_t at)
{
  Slice & slice = m_Slices[at];
  slice.points.resize(slice.cells.size());
  for (std::uint32_t i = 0; i < slice.cells.size(); ++i)
  {
    slice.points[i] = this->PointOf(slice, i);
  }
}

/** A slice along a wall has many cells, whose results need not be in memory at the same time. */
void
MedialVoxelSurfaceBuilder::HandOn(const Range & slices)
{
  std::vector<Part> parts;
  for (std::size_t at = slices.begin; at < slices.end; ++at)
  {
    const auto & cells = m_Slices[at].cells;
    const auto   number = static_cast<std::uint32_t>(cells.size());
    for (std::uint32_t begin = 0, end = 0; begin < number; begin = end)
    {
      end = std::min(begin + VerticesOfPart, number);
      while (end < number && KeyOf(cells[end]) == KeyOf(cells[end - 1]))
      {
        ++end;
      }
      parts.push_back({ at, begin, end });
      if (parts.size() == PartsAtATime)
      {
        this->HandOn(parts);
      }
    }
  }
  this->HandOn(parts);
}

void
MedialVoxelSurfaceBuilder::HandOn(std::vector<Part> & parts)
{
  m_RunTasks(parts.size(), [&](const std::size_t number) { this->Make(parts[number]); });
  for (const Part & part : parts)
  {
    MedialVoxelCheckAbort();
    m_Consumer.AddVertices(part.vertices);
    m_Consumer.AddQuads(part.quads);
  }
  parts.clear();
}

/** The faces of the vertices of a cell follow each other by axes. */
void
MedialVoxelSurfaceBuilder::Make(Part & part) const
{
  const Slice & slice = m_Slices[part.slice];
  const auto &  cells = slice.cells;
  part.vertices.reserve(part.end - part.begin);
  part.quads.reserve(part.end - part.begin);
  for (std::uint32_t begin = part.begin, end = begin; begin < part.end; begin = end)
  {
    unsigned int quads = 0;
    for (; end < part.end && KeyOf(cells[end]) == KeyOf(cells[begin]); ++end)
    {
      part.vertices.push_back({ slice.points[end], static_cast<double>(cells[end].thickness), cells[end].part });
      quads |= cells[end].quads;
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const unsigned int edge = Topology::EdgeOf(axis, 0, 0);
      for (std::uint32_t cell = begin; (quads >> edge & 1) != 0 && cell < end; ++cell)
      {
        if ((cells[cell].quads >> edge & 1) != 0)
        {
          part.quads.push_back(this->MakeQuad(part.slice, cell, axis));
        }
      }
    }
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
