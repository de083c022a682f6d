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

/** Vertices of a slice up to which its memory is kept for the next one. */
constexpr std::size_t MostSpareVertices = std::size_t{ 1 } << 16;

using Vector = MedialVoxelVector3;

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
  if (m_NumberOfWaiting > 0 && m_WaitingVertices + cells.size() > m_VerticesOfBatch)
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
    return Range{ newSlices.begin - std::min(newSlices.begin, number),
                  newSlices.end - std::min(newSlices.end, number) };
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
    std::transform(slice.cells.begin(),
                   slice.cells.end(),
                   slice.offsets.begin(),
                   [](const MedialVoxelSurfaceCell & cell) { return cell.offset; });
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

/** Move the vertices of a slice one step on, to its previous places. The slice after it is one step behind the result;
 * the one before it takes the step, too, or has taken it. */
void
MedialVoxelSurfaceBuilder::Smooth(const std::size_t at, const Range & slicesOfStep)
{
  Slice &         slice = m_Slices[at];
  const Offsets & own = slice.offsets;
  const Offsets & before = at == 0                         ? own
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
