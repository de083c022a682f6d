// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceCells.h"

#include "itkMedialVoxelSurfaceFit.h"

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

MedialVoxelIndex
NearestPoint(const MedialVoxelFeatures & features, const MedialVoxelIndex & voxel)
{
  const std::size_t at = features.OffsetOf(voxel[0], voxel[1], voxel[2]);
  return { { voxel[0] + features.dx[at], voxel[1] + features.dy[at], voxel[2] + features.dz[at] } };
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

MedialVoxelSurfaceCells::MedialVoxelSurfaceCells(const MedialVoxelGrid &              grid,
                                                 const MedialVoxelParameters &        parameters,
                                                 const MedialVoxelGrid::SpacingType & spacing)
  : m_Grid(grid)
  , m_Cell(grid)
  , m_Crossings(grid, parameters)
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
  const MedialVoxelBox missing = m_Crossings.Find(tile, workspace.crossings);
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
      const EdgeMask         crossed = workspace.crossings.GetCrossedEdges(index);
      if ((crossed & this->GetPossibleQuads(index)) != 0)
      {
        const bool isMedial = (((row.byBound | row.byGeodesic) >> x) & 1) != 0;
        cells.push_back(this->MakeCell(tile, index, crossed, isMedial));
      }
    }
  }
  return {};
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
MedialVoxelSurfaceCells::MakeCell(const MedialVoxelClassifiedTile & tile,
                                  const MedialVoxelIndex &          index,
                                  const EdgeMask                    crossed,
                                  const bool                        isMedial) const
{
  const MedialVoxelFeatures & features = tile.features;
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
  if (!isMedial || !tile.classifier.GetWallPoints(features, index, wall))
  {
    wall = nearest;
    wall.numberOfCorners = m_Cell.GetNumberOfCorners();
    for (unsigned int corner = 0; corner < wall.numberOfCorners; ++corner)
    {
      const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
      wall.corners[corner] = NearestPoint(features, { { index[0] + c[0], index[1] + c[1], index[2] + c[2] } });
    }
  }
  cell.thickness = m_Thickness.Measure(*tile.window.object, wall).thickness;
  return cell;
}

} // end namespace itk
