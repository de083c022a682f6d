// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceBuilder.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>

namespace itk
{

using Topology = MedialVoxelSurfaceTopology;

namespace
{

/** Vertices of a part that is handed on. */
constexpr std::uint32_t VerticesOfPart = 1u << 13;

/** That no plane with rational coefficients holds. */
constexpr std::array<double, 3> FrontDirection{ { 1.0, 1.4142135623730951, 1.7320508075688772 } };

using Vector = MedialVoxelVector3;

double
AreaOfTriangle(const Vector & a, const Vector & b, const Vector & c)
{
  const Vector normal = MedialVoxelCross(MedialVoxelSubtract(b, a), MedialVoxelSubtract(c, a));
  return 0.5 * MedialVoxelNorm(normal);
}

} // namespace

/** A slice along a wall has many cells, whose results need not be in memory at the same time. */
void
MedialVoxelSurfaceBuilder::HandOn(const Range & slices)
{
  const std::size_t partsAtATime = std::max<std::size_t>(1, m_VerticesOfBatch / VerticesOfPart);
  std::vector<Part> parts;
  for (std::size_t at = slices.begin; at < slices.end; ++at)
  {
    const auto & cells = m_Slices[at].cells;
    const auto   number = static_cast<std::uint32_t>(cells.size());
    for (std::uint32_t begin = 0, end = 0; begin < number; begin = end)
    {
      end = std::min(begin + VerticesOfPart, number);
      while (end < number && cells[end].index == cells[end - 1].index)
      {
        ++end;
      }
      parts.push_back({ at, begin, end });
      if (parts.size() >= partsAtATime)
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
    for (; end < part.end && cells[end].index == cells[begin].index; ++end)
    {
      part.vertices.push_back(
        { slice.points[end], static_cast<double>(cells[end].thickness), cells[end].part, cells[end].index });
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

} // end namespace itk
