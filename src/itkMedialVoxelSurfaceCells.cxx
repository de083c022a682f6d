// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceCells.h"

#include "itkMedialVoxelSurfaceFit.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace itk
{

using WordType = MedialVoxelBits::WordType;
using EdgeMask = MedialVoxelSurfaceTopology::EdgeMask;

namespace
{

/** Weight of the center of a cell against a pair, and the way of a vertex from it, in voxels. */
constexpr double Pull = 0.1;
constexpr double Reach = 1.0;

MedialVoxelParameters
WithProvedBound(MedialVoxelParameters parameters)
{
  parameters.bound = MedialVoxelPseudoGeodesicBound::FreeSpace;
  return parameters;
}

MedialVoxelDisplacement
DisplacementAt(const MedialVoxelFeatures & features, const std::size_t at)
{
  return { { features.dx[at], features.dy[at], features.dz[at] } };
}

MedialVoxelIndex
NearestPoint(const MedialVoxelFeatures & features, const MedialVoxelIndex & voxel)
{
  const std::size_t at = features.OffsetOf(voxel[0], voxel[1], voxel[2]);
  return { { voxel[0] + features.dx[at], voxel[1] + features.dy[at], voxel[2] + features.dz[at] } };
}

bool
IsAdjacent(const MedialVoxelDisplacement & difference)
{
  return std::abs(difference[0]) <= 1 && std::abs(difference[1]) <= 1 && std::abs(difference[2]) <= 1;
}

/** The two ends of a voxel edge of a cell. */
struct EdgeEnds
{
  EdgeEnds(const MedialVoxelIndex & cell, const unsigned int edge)
    : lower(MedialVoxelSurfaceTopology::OffsetOf(edge))
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lower[axis] += cell[axis];
    }
    upper = lower;
    ++upper[MedialVoxelSurfaceTopology::AxisOf(edge)];
  }

  MedialVoxelIndex lower;
  MedialVoxelIndex upper;
};

} // namespace

/** A tile, the cells of it that the image has, and the masks of their crossed edges. */
struct MedialVoxelSurfaceCells::Tile
{
  const MedialVoxelClassifiedTile & classified;
  MedialVoxelBox                    cells;
  MedialVoxelBox                    voxels;
  std::vector<EdgeMask> &           crossed;

  EdgeMask &
  At(const MedialVoxelIndex & cell) const
  {
    return crossed[static_cast<std::size_t>(
      ((cell[2] - cells.lower[2]) * cells.Extent(1) + (cell[1] - cells.lower[1])) * cells.Extent(0) +
      (cell[0] - cells.lower[0]))];
  }
};

/** Voxels of which the edges along an axis are looked at. */
struct MedialVoxelSurfaceCells::Row
{
  unsigned int axis;
  std::int64_t y;
  std::int64_t z;
};

MedialVoxelSurfaceCells::MedialVoxelSurfaceCells(const MedialVoxelGrid &              grid,
                                                 const MedialVoxelParameters &        parameters,
                                                 const MedialVoxelGrid::SpacingType & spacing)
  : m_Grid(grid)
  , m_Parameters(WithProvedBound(parameters))
  , m_Cell(grid)
  , m_Decision(grid, m_Parameters)
  , m_PhysicalGrid(grid.GetSize(), spacing)
  , m_Thickness(m_PhysicalGrid)
  , m_IsSolid(grid.IsActive(0) && grid.IsActive(1) && grid.IsActive(2))
{}

MedialVoxelBox
MedialVoxelSurfaceCells::Find(const MedialVoxelClassifiedTile &     tile,
                              Workspace &                           workspace,
                              std::vector<MedialVoxelSurfaceCell> & cells) const
{
  cells.clear();
  if (!m_IsSolid)
  {
    return {};
  }
  const Tile own{
    tile, tile.box.Intersection(m_Grid.GetCellBox()), tile.classifier.GetVoxelBox(tile.box), workspace.crossed
  };
  workspace.crossed.assign(static_cast<std::size_t>(own.cells.NumberOfVoxels()), 0);
  const MedialVoxelBox missing = this->FindCrossedEdges(own);
  if (!missing.IsEmpty())
  {
    return missing;
  }
  // Every cell of a quadrilateral has an object voxel among its corners.
  for (const MedialVoxelCellRow & row : tile.rows)
  {
    for (WordType rest = row.candidates; rest != 0; rest &= rest - 1)
    {
      const int              x = MedialVoxelLowestBit(rest);
      const MedialVoxelIndex index{ { row.first[0] + x, row.first[1], row.first[2] } };
      const EdgeMask         crossed = own.At(index);
      if ((crossed & this->GetPossibleQuads(index)) != 0)
      {
        const bool isMedial = (((row.byBound | row.byGeodesic) >> x) & 1) != 0;
        cells.push_back(this->MakeCell(own, index, crossed, isMedial));
      }
    }
  }
  return {};
}

MedialVoxelBox
MedialVoxelSurfaceCells::FindCrossedEdges(const Tile & tile) const
{
  MedialVoxelBox missing;
  for (std::int64_t z = tile.voxels.lower[2]; z < tile.voxels.upper[2]; ++z)
  {
    for (std::int64_t y = tile.voxels.lower[1]; y < tile.voxels.upper[1]; ++y)
    {
      if (tile.classified.progress.IsAborted())
      {
        return {};
      }
      this->FindCrossedEdgesOfRow(tile, { 0, y, z }, missing);
      if (y + 1 < tile.voxels.upper[1])
      {
        this->FindCrossedEdgesOfRow(tile, { 1, y, z }, missing);
      }
      if (z + 1 < tile.voxels.upper[2])
      {
        this->FindCrossedEdgesOfRow(tile, { 2, y, z }, missing);
      }
    }
  }
  return missing;
}

void
MedialVoxelSurfaceCells::FindCrossedEdgesOfRow(const Tile & tile, const Row & row, MedialVoxelBox & missing) const
{
  const MedialVoxelFeatures & features = tile.classified.features;
  const MedialVoxelBits &     object = *tile.classified.window.object;
  const WordType * const      words = object.GetRow(row.y, row.z) - object.GetFirstWord();
  const WordType * const      otherWords =
    object.GetRow(row.y + (row.axis == 1 ? 1 : 0), row.z + (row.axis == 2 ? 1 : 0)) - object.GetFirstWord();
  const MedialVoxelIndex step{ { row.axis == 0 ? 1 : 0, row.axis == 1 ? 1 : 0, row.axis == 2 ? 1 : 0 } };
  const std::size_t      first = features.OffsetOf(tile.voxels.lower[0], row.y, row.z);
  const std::size_t      toOther =
    features.OffsetOf(tile.voxels.lower[0] + step[0], row.y + step[1], row.z + step[2]) - first;
  const std::int64_t end = tile.voxels.upper[0] - step[0];
  const bool         edgesAreTrivial = m_Grid.GetLongestEdge() < m_Parameters.epsilon;

  for (std::int64_t word = tile.voxels.lower[0] >> 6; word <= (tile.voxels.upper[0] - 1) >> 6; ++word)
  {
    const WordType others =
      row.axis == 0 ? (words[word] >> 1) | (words[word + 1] << (MedialVoxelBits::BitsPerWord - 1)) : otherWords[word];
    for (WordType rest = (words[word] | others) & MedialVoxelBits::RangeMask(word, tile.voxels.lower[0], end);
         rest != 0;
         rest &= rest - 1)
    {
      const std::int64_t x = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(rest);
      const std::size_t  at = first + static_cast<std::size_t>(x - tile.voxels.lower[0]);
      MedialVoxelPair    pair;
      pair.displacement = DisplacementAt(features, at);
      pair.oppositeDisplacement = DisplacementAt(features, at + toOther);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        pair.difference[axis] = pair.displacement[axis] - pair.oppositeDisplacement[axis] - step[axis];
      }
      if ((edgesAreTrivial && IsAdjacent(pair.difference)) || !features.HasSite(at) || !features.HasSite(at + toOther))
      {
        continue;
      }
      pair.a = { { x + pair.displacement[0], row.y + pair.displacement[1], row.z + pair.displacement[2] } };
      if (this->IsCrossed(tile, pair, missing))
      {
        this->MarkCells(tile, { { x, row.y, row.z } }, row.axis);
      }
    }
  }
}

bool
MedialVoxelSurfaceCells::IsCrossed(const Tile & tile, const MedialVoxelPair & pair, MedialVoxelBox & missing) const
{
  return !m_Cell.IsTrivial(pair.difference, m_Parameters.epsilon) &&
         m_Decision.Decide(*tile.classified.window.sites, pair, tile.classified.geodesic, missing) !=
           MedialVoxelLabel::NonMedial;
}

/** Set the bit of a crossed edge at the cells around it that the tile has. */
void
MedialVoxelSurfaceCells::MarkCells(const Tile & tile, const MedialVoxelIndex & voxel, const unsigned int axis) const
{
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    const unsigned int edge = 4 * axis + corner;
    MedialVoxelIndex   cell = MedialVoxelSurfaceTopology::OffsetOf(edge);
    for (unsigned int i = 0; i < 3; ++i)
    {
      cell[i] = voxel[i] - cell[i];
    }
    if (tile.cells.Contains(cell))
    {
      tile.At(cell) = static_cast<EdgeMask>(tile.At(cell) | (1u << edge));
    }
  }
}

/** The edges of a cell that have four cells around them: those that do not lie in a face of the image. */
EdgeMask
MedialVoxelSurfaceCells::GetPossibleQuads(const MedialVoxelIndex & cell) const
{
  unsigned int mask = (1u << MedialVoxelSurfaceTopology::NumberOfEdges) - 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (cell[axis] == 0)
    {
      mask &= ~unsigned{ MedialVoxelSurfaceTopology::EdgesTowards(2 * axis) };
    }
    if (cell[axis] + 2 == m_Grid.GetSize()[axis])
    {
      mask &= ~unsigned{ MedialVoxelSurfaceTopology::EdgesTowards(2 * axis + 1) };
    }
  }
  return static_cast<EdgeMask>(mask);
}

MedialVoxelSurfaceCell
MedialVoxelSurfaceCells::MakeCell(const Tile &             tile,
                                  const MedialVoxelIndex & index,
                                  const EdgeMask           crossed,
                                  const bool               isMedial) const
{
  const MedialVoxelFeatures & features = tile.classified.features;
  const auto &                spacing = m_PhysicalGrid.GetSpacing();
  const auto                  fromCenter = [&](const MedialVoxelIndex & point) {
    MedialVoxelSurfaceFit::PointType result;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      result[axis] = (static_cast<double>(point[axis] - index[axis]) - 0.5) * spacing[axis];
    }
    return result;
  };

  MedialVoxelSurfaceFit fit;
  MedialVoxelWallPoints nearest;
  double                smallest = std::numeric_limits<double>::infinity();
  for (unsigned int rest = crossed; rest != 0; rest &= rest - 1)
  {
    const EdgeEnds         ends(index, static_cast<unsigned int>(MedialVoxelLowestBit(rest)));
    const MedialVoxelIndex a = NearestPoint(features, ends.lower);
    const MedialVoxelIndex b = NearestPoint(features, ends.upper);
    fit.AddPair(fromCenter(a), fromCenter(b));
    const double squared = m_PhysicalGrid.SquaredMetricLength(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    if (squared < smallest)
    {
      smallest = squared;
      nearest.a = a;
      nearest.b = b;
    }
  }

  MedialVoxelSurfaceCell cell;
  const auto             point = fit.GetPoint(Pull, { { Reach * spacing[0], Reach * spacing[1], Reach * spacing[2] } });
  const auto             plane = fit.GetPlane();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    cell.index[axis] = static_cast<std::int32_t>(index[axis]);
    cell.offset[axis] = static_cast<float>(point[axis]);
    cell.normal[axis] = static_cast<float>(plane.normal[axis]);
  }
  cell.distance = static_cast<float>(plane.distance);
  cell.quads = static_cast<EdgeMask>(crossed & this->GetPossibleQuads(index));

  MedialVoxelWallPoints wall;
  if (!isMedial || !tile.classified.classifier.GetWallPoints(features, index, wall))
  {
    wall = nearest;
    wall.numberOfCorners = m_Cell.GetNumberOfCorners();
    for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
    {
      const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
      wall.corners[corner] = NearestPoint(features, { { index[0] + c[0], index[1] + c[1], index[2] + c[2] } });
    }
  }
  cell.thickness = m_Thickness.Measure(*tile.classified.window.object, wall).thickness;
  return cell;
}

} // end namespace itk
