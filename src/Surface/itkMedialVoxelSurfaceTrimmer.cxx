// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceTrimmer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace itk
{

using Topology = MedialVoxelSurfaceTopology;

namespace
{

/** Number that the edge of a quadrilateral has in the cell of a corner: from the cell of its voxel down along the next
 * axis, the one after it, and up again. */
unsigned int
EdgeAtCorner(const unsigned int axis, const unsigned int corner)
{
  return Topology::EdgeOf(axis, corner == 1 || corner == 2 ? 1 : 0, corner / 2);
}

bool
HasOneEdge(const Topology::EdgeMask edges)
{
  return (edges & (edges - 1)) == 0;
}

} // namespace

MedialVoxelSurfaceTrimmer::MedialVoxelSurfaceTrimmer(MedialVoxelSurfaceBuilder & builder)
  : m_Builder(builder)
{}

void
MedialVoxelSurfaceTrimmer::AddSlice(const std::int64_t z, std::vector<MedialVoxelSurfaceCell> cells)
{
  if (m_Before.z + 1 != z)
  {
    this->HandOnBefore();
  }
  m_Newest.z = z;
  m_Newest.cells = std::move(cells);
  // A removed quadrilateral has at least two vertices without others.
  this->TrimAtVerticesOf(m_Before);
  this->TrimAtVerticesOf(m_Newest);
  this->HandOnBefore();
  m_Before = std::exchange(m_Newest, {});
}

void
MedialVoxelSurfaceTrimmer::Finish()
{
  this->HandOnBefore();
  m_Builder.Finish();
}

/** Mark quadrilaterals whose highest cell is in the newest slice and that have a vertex of \a slice for themselves. */
void
MedialVoxelSurfaceTrimmer::TrimAtVerticesOf(const Slice & slice)
{
  for (const MedialVoxelSurfaceCell & cell : slice.cells)
  {
    if (!HasOneEdge(cell.quads))
    {
      continue;
    }
    const auto             edge = static_cast<unsigned int>(MedialVoxelLowestBit(cell.quads));
    const unsigned int     axis = Topology::AxisOf(edge);
    const MedialVoxelIndex offset = Topology::OffsetOf(edge);
    const MedialVoxelIndex voxel{ { cell.index[0] + offset[0], cell.index[1] + offset[1], cell.index[2] + offset[2] } };
    if (voxel[2] != m_Newest.z)
    {
      continue;
    }
    const Corners corners = this->FindCorners(voxel, axis);
    if (IsToBeTrimmed(corners, axis))
    {
      for (unsigned int corner = 0; corner < corners.size(); ++corner)
      {
        auto & trimmed = corners[corner].slice->trimmed;
        trimmed.resize(corners[corner].slice->cells.size());
        Topology::EdgeMask & edges = trimmed[corners[corner].position];
        edges = static_cast<Topology::EdgeMask>(edges | 1u << EdgeAtCorner(axis, corner));
      }
    }
  }
}

/** The vertices of the quadrilateral of a voxel edge. */
auto
MedialVoxelSurfaceTrimmer::FindCorners(const MedialVoxelIndex & voxel, const unsigned int axis) -> Corners
{
  Corners corners{};
  for (unsigned int corner = 0; corner < corners.size(); ++corner)
  {
    const unsigned int     edge = EdgeAtCorner(axis, corner);
    const MedialVoxelIndex offset = Topology::OffsetOf(edge);
    MedialVoxelSurfaceCell sought;
    for (unsigned int i = 0; i < 3; ++i)
    {
      sought.index[i] = static_cast<std::int32_t>(voxel[i] - offset[i]);
    }
    sought.quads = 1;
    Slice &    slice = sought.index[2] == m_Newest.z ? m_Newest : m_Before;
    const auto first = std::lower_bound(slice.cells.begin(), slice.cells.end(), sought, MedialVoxelIsBefore);
    const auto found = std::find_if(first, slice.cells.end(), [&](const MedialVoxelSurfaceCell & cell) {
      return cell.index != sought.index || (cell.quads >> edge & 1) != 0;
    });
    if (found == slice.cells.end() || found->index != sought.index)
    {
      throw std::logic_error("A quadrilateral of the medial surface lacks a vertex.");
    }
    corners[corner] = { &slice, static_cast<std::size_t>(found - slice.cells.begin()) };
  }
  return corners;
}

bool
MedialVoxelSurfaceTrimmer::IsToBeTrimmed(const Corners & corners, const unsigned int axis)
{
  const auto countBetween = [&](const unsigned int from, const unsigned int to, const unsigned int along) {
    return Topology::QuadsBetween(corners[from].slice->cells[corners[from].position].quads,
                                  corners[to].slice->cells[corners[to].position].quads,
                                  2 * along);
  };
  const unsigned int next = (axis + 1) % 3;
  const unsigned int afterNext = (axis + 2) % 3;
  const unsigned int counts[4] = {
    countBetween(0, 1, next), countBetween(1, 2, afterNext), countBetween(3, 2, next), countBetween(0, 3, afterNext)
  };
  const auto rims = std::count(std::begin(counts), std::end(counts), 1u);
  return rims == 4 ? !std::all_of(corners.begin(), corners.end(), IsAloneInCell)
                   : rims == 3 && std::count(std::begin(counts), std::end(counts), 2u) == 0;
}

/** Whether the cell of a vertex has no other one. */
bool
MedialVoxelSurfaceTrimmer::IsAloneInCell(const Corner & corner)
{
  const auto & cells = corner.slice->cells;
  const auto & index = cells[corner.position].index;
  return (corner.position == 0 || cells[corner.position - 1].index != index) &&
         (corner.position + 1 == cells.size() || cells[corner.position + 1].index != index);
}

/** Give the builder the slice before the newest one, whose quadrilaterals are decided. */
void
MedialVoxelSurfaceTrimmer::HandOnBefore()
{
  auto & cells = m_Before.cells;
  if (!m_Before.trimmed.empty())
  {
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      cells[i].quads = static_cast<Topology::EdgeMask>(cells[i].quads & ~unsigned{ m_Before.trimmed[i] });
    }
    cells.erase(std::remove_if(cells.begin(), cells.end(), [](const auto & cell) { return cell.quads == 0; }),
                cells.end());
    // A vertex may have lost its lowest edge, which matters where a cell has several.
    if (!std::is_sorted(cells.begin(), cells.end(), MedialVoxelIsBefore))
    {
      std::sort(cells.begin(), cells.end(), MedialVoxelIsBefore);
    }
  }
  if (!cells.empty())
  {
    m_Builder.AddSlice(m_Before.z, std::move(cells));
  }
  m_Before = {};
}

} // end namespace itk
