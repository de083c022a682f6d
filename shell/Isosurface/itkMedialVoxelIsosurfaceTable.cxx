// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelIsosurfaceTable.h"

#include <algorithm>
#include <optional>

namespace itk
{
namespace
{

using Table = MedialVoxelIsosurfaceTable;
using Loop = std::vector<std::uint8_t>; // edges

constexpr unsigned int NumberOfCases = 256;
constexpr std::uint8_t NoEdge = 0xff;

std::uint8_t
GetEdge(unsigned int cornerA, unsigned int cornerB)
{
  const unsigned int lower = cornerA & cornerB;
  for (unsigned int edge = 0; edge < Table::NumberOfEdges; ++edge)
  {
    if (Table::GetLowerCorner(edge) == lower && (lower | 1u << Table::GetAxis(edge)) == (cornerA | cornerB))
    {
      return static_cast<std::uint8_t>(edge);
    }
  }
  return NoEdge;
}

/** Corners of a side of the cell, counter-clockwise seen from outside of the cell. */
std::array<unsigned int, 4>
GetCornersOfSide(unsigned int axis, unsigned int side)
{
  const unsigned int          first = side << axis;
  const unsigned int          u = 1u << (axis + 1) % 3;
  const unsigned int          v = 1u << (axis + 2) % 3;
  std::array<unsigned int, 4> corners{ first, first | u, first | u | v, first | v };
  if (side == 0)
  {
    std::reverse(corners.begin(), corners.end());
  }
  return corners;
}

/** Bits of the two sides of the cell that an edge lies in. */
unsigned int
GetSidesOfEdge(unsigned int edge)
{
  unsigned int sides = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (axis != Table::GetAxis(edge))
    {
      sides |= 1u << (2 * axis + (Table::GetLowerCorner(edge) >> axis & 1u));
    }
  }
  return sides;
}

/** For each edge that the surface crosses, the next one, clockwise seen from outside of the object. Background corners
 * are cut off one by one where object corners are opposite. */
std::array<std::uint8_t, Table::NumberOfEdges>
LinkEdges(unsigned int objectCorners)
{
  std::array<std::uint8_t, Table::NumberOfEdges> next{};
  next.fill(NoEdge);
  const auto isObject = [objectCorners](unsigned int corner) { return (objectCorners >> corner & 1u) != 0; };
  for (unsigned int side = 0; side < 6; ++side)
  {
    const auto corners = GetCornersOfSide(side / 2, side % 2);
    const auto at = [&corners](unsigned int k) { return corners[k % 4]; };
    for (unsigned int k = 0; k < 4; ++k)
    {
      if (isObject(at(k)) && !isObject(at(k + 1)))
      {
        unsigned int end = k + 1;
        while (!isObject(at(end + 1)))
        {
          ++end;
        }
        next[GetEdge(at(k), at(k + 1))] = GetEdge(at(end), at(end + 1));
      }
    }
  }
  return next;
}

std::vector<Loop>
FindLoops(unsigned int objectCorners)
{
  auto              next = LinkEdges(objectCorners);
  std::vector<Loop> loops;
  for (std::uint8_t first = 0; first < Table::NumberOfEdges; ++first)
  {
    Loop loop;
    for (std::uint8_t edge = first; next[edge] != NoEdge;)
    {
      loop.push_back(edge);
      const std::uint8_t following = next[edge];
      next[edge] = NoEdge;
      edge = following;
    }
    if (!loop.empty())
    {
      loops.push_back(loop);
    }
  }
  return loops;
}

/** Triangles of a part of a loop, from its first to its last edge, that have no side within a side of the cell but
 * those of the loop; nothing when there are none. */
std::optional<std::vector<Table::Triangle>>
Triangulate(const Loop & loop)
{
  using Triangles = std::vector<Table::Triangle>;
  if (loop.size() < 3)
  {
    return Triangles{};
  }
  const auto isFree = [&loop](std::size_t a, std::size_t b) {
    return b - a == 1 || (GetSidesOfEdge(loop[a]) & GetSidesOfEdge(loop[b])) == 0;
  };
  for (std::size_t apex = 1; apex + 1 < loop.size(); ++apex)
  {
    if (!isFree(0, apex) || !isFree(apex, loop.size() - 1))
    {
      continue;
    }
    const auto split = loop.begin() + static_cast<std::ptrdiff_t>(apex);
    const auto before = Triangulate(Loop(loop.begin(), split + 1));
    const auto after = Triangulate(Loop(split, loop.end()));
    if (before && after)
    {
      Triangles triangles{ { loop.front(), loop.back(), loop[apex] } };
      triangles.insert(triangles.end(), before->begin(), before->end());
      triangles.insert(triangles.end(), after->begin(), after->end());
      return triangles;
    }
  }
  return std::nullopt;
}

std::array<std::vector<Table::Triangle>, NumberOfCases>
MakeTable()
{
  std::array<std::vector<Table::Triangle>, NumberOfCases> table;
  for (unsigned int corners = 0; corners < NumberOfCases; ++corners)
  {
    for (const Loop & loop : FindLoops(corners))
    {
      const auto triangles = Triangulate(loop).value(); // a test holds that all loops have some
      table[corners].insert(table[corners].end(), triangles.begin(), triangles.end());
    }
  }
  return table;
}

} // namespace

unsigned int
MedialVoxelIsosurfaceTable::GetLowerCorner(unsigned int edge)
{
  constexpr std::array<unsigned int, NumberOfEdges> corners{ 0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3 };
  return corners[edge];
}

const std::vector<MedialVoxelIsosurfaceTable::Triangle> &
MedialVoxelIsosurfaceTable::Get(unsigned int objectCorners)
{
  static const auto table = MakeTable();
  return table[objectCorners];
}

} // end namespace itk
