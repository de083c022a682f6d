// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceCells.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <limits>

namespace itk
{

using WordType = MedialVoxelBits::WordType;
using EdgeMask = MedialVoxelSurfaceTopology::EdgeMask;

namespace
{

/** Weight of the center of a cell against a pair, and the distance of a vertex from it, in voxels. */
constexpr double Pull = 0.1;
constexpr double Reach = 1.0;

/** Cosine of the normals of two walls from which they no longer lie across from each other. */
constexpr double SameSide = 0.5;

/** Numbers of the corners of a cell at the ends of one of its voxel edges. */
struct EdgeEnds
{
  constexpr explicit EdgeEnds(const unsigned int edge)
  {
    const MedialVoxelIndex & offset = MedialVoxelSurfaceTopology::OffsetOf(edge);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lower |= static_cast<unsigned int>(offset[axis]) << axis;
    }
    upper = lower | 1u << MedialVoxelSurfaceTopology::AxisOf(edge);
  }

  unsigned int lower{ 0 };
  unsigned int upper{ 0 };
};

constexpr EdgeEnds EndsOfEdges[MedialVoxelSurfaceTopology::NumberOfEdges] = { EdgeEnds(0), EdgeEnds(1),  EdgeEnds(2),
                                                                              EdgeEnds(3), EdgeEnds(4),  EdgeEnds(5),
                                                                              EdgeEnds(6), EdgeEnds(7),  EdgeEnds(8),
                                                                              EdgeEnds(9), EdgeEnds(10), EdgeEnds(11) };

/** Calls visit(ends) for the edges of a mask. */
template <typename TVisitor>
void
ForEachEdge(const EdgeMask edges, TVisitor && visit)
{
  for (unsigned int rest = edges; rest != 0; rest &= rest - 1)
  {
    visit(EndsOfEdges[MedialVoxelLowestBit(rest)]);
  }
}

} // namespace

MedialVoxelSurfaceCells::MedialVoxelSurfaceCells(const MedialVoxelGrid &              grid,
                                                 const MedialVoxelParameters &        parameters,
                                                 const MedialVoxelGrid::SpacingType & spacing)
  : m_Grid(grid)
  , m_Cell(grid)
  , m_Crossings(grid, parameters)
  , m_PhysicalGrid(grid.GetSize(), spacing)
  , m_Thickness(m_PhysicalGrid)
  , m_SharesWalls(grid.GetSpacing() == spacing)
  , m_DecidesTogether(MedialVoxelClassifier::DecidesTogether(grid, parameters))
  , m_IsSolid(grid.IsActive(0) && grid.IsActive(1) && grid.IsActive(2))
{}

void
MedialVoxelSurfaceCells::MeasureOnGrayValues(const MedialVoxelSheetExtraction::GrayRange & range)
{
  m_Gray.emplace(m_PhysicalGrid, range.lower, range.upper, range.scan);
}

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
  MedialVoxelBox missing = m_Crossings.Find(tile, workspace.crossings);
  if (!missing.IsEmpty())
  {
    return missing;
  }
  workspace.thickness.Clear();
  // Every cell of a quadrilateral has an object voxel among its corners.
  MedialVoxelAbortChecker checker;
  auto                    firstWall = tile.walls.begin(); // of the row
  for (const MedialVoxelCellRow & row : tile.rows)
  {
    constexpr std::uint32_t stepsPerRow = 256;
    checker.Count(stepsPerRow);
    const auto walls = firstWall;
    firstWall += MedialVoxelPopulationCount(row.measured);
    for (WordType rest = row.candidates; rest != 0; rest &= rest - 1)
    {
      const int              x = MedialVoxelLowestBit(rest);
      const MedialVoxelIndex index{ { row.first[0] + x, row.first[1], row.first[2] } };
      const EdgeMask         crossed = workspace.crossings.TakeCrossedEdges(index);
      if (crossed == 0)
      {
        continue;
      }
      const WordType         bit = WordType{ 1 } << x;
      const bool             isMedial = ((row.byBound | row.byGeodesic) & bit) != 0;
      const bool             hasWall = m_SharesWalls && (row.measured & bit) != 0;
      const auto             quads = static_cast<EdgeMask>(crossed & this->GetPossibleQuads(index));
      MedialVoxelSurfaceCell cell;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        cell.index[axis] = static_cast<std::int32_t>(index[axis]);
      }
      const auto splits = this->FindSplits(tile, index, quads, workspace, missing);
      for (unsigned int open = quads; open != 0; open &= ~unsigned{ cell.quads })
      {
        cell.quads = MedialVoxelSurfaceTopology::FirstPart(static_cast<EdgeMask>(open), splits);
        const bool isAlone = cell.quads == quads;
        Basis      basis{ isAlone ? crossed : cell.quads, isMedial && isAlone };
        if (hasWall && isAlone)
        {
          basis.wall = &walls[MedialVoxelPopulationCount(row.measured & (bit - 1))];
        }
        this->AddVertex(tile, cell, basis, workspace, cells, missing);
      }
    }
  }
  workspace.crossings.Finish();
  return missing;
}

/** The splits of all faces whose four edges are crossed. */
MedialVoxelSurfaceTopology::Splits
MedialVoxelSurfaceCells::FindSplits(const MedialVoxelClassifiedTile & tile,
                                    const MedialVoxelIndex &          index,
                                    const EdgeMask                    quads,
                                    Workspace &                       workspace,
                                    MedialVoxelBox &                  missing) const
{
  MedialVoxelSurfaceTopology::Splits splits = 0;
  for (unsigned int rest = MedialVoxelSurfaceTopology::AmbiguousDirections(quads); rest != 0; rest &= rest - 1)
  {
    const auto direction = static_cast<unsigned int>(MedialVoxelLowestBit(rest));
    splits = MedialVoxelSurfaceTopology::WithSplit(
      splits, direction, m_Crossings.FindSplit(tile, index, direction, workspace.crossings, missing));
  }
  return splits;
}

/** Adds a vertex with the edges of \a cell. */
void
MedialVoxelSurfaceCells::AddVertex(const MedialVoxelClassifiedTile &     tile,
                                   const MedialVoxelSurfaceCell &        cell,
                                   const Basis &                         basis,
                                   Workspace &                           workspace,
                                   std::vector<MedialVoxelSurfaceCell> & cells,
                                   MedialVoxelBox &                      missing) const
{
  const MedialVoxelIndex      index{ { cell.index[0], cell.index[1], cell.index[2] } };
  const MedialVoxelWallPoints points = this->GetWallPoints(tile, index, basis);
  const MedialVoxelBox        values = m_Gray ? m_Gray->GetReadBox(points) : MedialVoxelBox{};
  if (!tile.gray.GetBox().Contains(values))
  {
    missing = missing.Union(values);
    return;
  }
  cells.push_back(cell);
  this->Place(tile, basis, points, workspace, cells.back());
}

/** The edges of a cell that have four cells around them, not in a face of the image. */
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

/** The pair of a medial cell; for others, the two points that are nearest to each other. */
MedialVoxelWallPoints
MedialVoxelSurfaceCells::GetWallPoints(const MedialVoxelClassifiedTile & tile,
                                       const MedialVoxelIndex &          index,
                                       const Basis &                     basis) const
{
  MedialVoxelWallPoints points;
  const bool            isKnown = basis.isMedial && m_DecidesTogether &&
                       MedialVoxelJointClassifier::GetPair(tile.classification.joint, index, points.a, points.b);
  if (basis.isMedial && !isKnown && tile.classifier.GetWallPoints(tile.features, index, points))
  {
    return points;
  }
  points.cell = index;
  points.numberOfCorners = m_Cell.GetNumberOfCorners();
  const MedialVoxelFeatures & features = tile.features;
  const std::size_t           first = features.OffsetOf(index[0], index[1], index[2]);
  const auto                  row = static_cast<std::size_t>(features.box.Extent(0));
  const auto                  slice = row * static_cast<std::size_t>(features.box.Extent(1));
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
    const std::size_t               at = first + (c[0] != 0 ? 1 : 0) + (c[1] != 0 ? row : 0) + (c[2] != 0 ? slice : 0);
    points.corners[corner] = {
      { index[0] + c[0] + features.dx[at], index[1] + c[1] + features.dy[at], index[2] + c[2] + features.dz[at] }
    };
  }
  if (!isKnown)
  {
    this->TakeNearestPair(basis.crossed, points);
  }
  return points;
}

/** Sets a and b to the points at the ends of a crossed edge that are nearest to each other. */
void
MedialVoxelSurfaceCells::TakeNearestPair(const EdgeMask crossed, MedialVoxelWallPoints & points) const
{
  double smallest = std::numeric_limits<double>::infinity();
  ForEachEdge(crossed, [&](const EdgeEnds & ends) {
    const MedialVoxelIndex & a = points.corners[ends.lower];
    const MedialVoxelIndex & b = points.corners[ends.upper];
    const double             squared = m_PhysicalGrid.SquaredMetricLength(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    if (squared < smallest)
    {
      smallest = squared;
      points.a = a;
      points.b = b;
    }
  });
}

/** Set place, plane and thickness. */
void
MedialVoxelSurfaceCells::Place(const MedialVoxelClassifiedTile & tile,
                               const Basis &                     basis,
                               const MedialVoxelWallPoints &     points,
                               Workspace &                       workspace,
                               MedialVoxelSurfaceCell &          cell) const
{
  const MedialVoxelIndex index{ { cell.index[0], cell.index[1], cell.index[2] } };
  MedialVoxelSurfaceFit  fit;
  if (m_Gray)
  {
    const auto crossings = m_Gray->FindCrossings(tile.gray, points);
    this->FitToGrayValues(tile.gray, index, basis.crossed, points, crossings, fit);
    if (basis.wall != nullptr)
    {
      cell.thickness = basis.wall->thickness;
    }
    else
    {
      MedialVoxelWall wall = m_Thickness.Measure(*tile.window.object, points, workspace.thickness);
      m_Gray->Refine(tile.gray, points, crossings, tile.fits, wall);
      cell.thickness = wall.thickness;
    }
  }
  else
  {
    cell.thickness = m_Thickness.MeasureThickness(*tile.window.object, points, workspace.thickness);
    std::array<MedialVoxelSurfaceFit::PointType, 8> corners;
    std::transform(points.corners.begin(), points.corners.end(), corners.begin(), [&](const MedialVoxelIndex & corner) {
      return this->FromCenter(index, corner);
    });
    ForEachEdge(basis.crossed, [&](const EdgeEnds & ends) { fit.AddPair(corners[ends.lower], corners[ends.upper]); });
  }

  const auto & spacing = m_PhysicalGrid.GetSpacing();
  const auto   point = fit.GetPoint(Pull, { { Reach * spacing[0], Reach * spacing[1], Reach * spacing[2] } });
  const auto   plane = fit.GetPlane();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    cell.offset[axis] = static_cast<float>(point[axis]);
    cell.normal[axis] = static_cast<float>(plane.normal[axis]);
  }
  cell.distance = static_cast<float>(plane.distance);
}

/** Counts in the crossed edges with their boundary points moved; without one next to a point, with both as they are. */
void
MedialVoxelSurfaceCells::FitToGrayValues(const MedialVoxelGray &                     gray,
                                         const MedialVoxelIndex &                    index,
                                         const EdgeMask                              crossed,
                                         const MedialVoxelWallPoints &               points,
                                         const MedialVoxelGrayThickness::Crossings & crossings,
                                         MedialVoxelSurfaceFit &                     fit) const
{
  using Crossing = MedialVoxelGrayBoundary::Crossing;
  const auto tangentOf = [&](const Crossing & crossing) {
    MedialVoxelSurfaceFit::Tangent tangent{ crossing.position, crossing.normal };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      tangent.point[axis] -= (static_cast<double>(index[axis]) + 0.5) * m_PhysicalGrid.GetSpacing()[axis];
    }
    return tangent;
  };
  ForEachEdge(crossed, [&](const EdgeEnds & ends) {
    const MedialVoxelSurfaceFit::PointType a = this->FromCenter(index, points.corners[ends.lower]);
    const MedialVoxelSurfaceFit::PointType b = this->FromCenter(index, points.corners[ends.upper]);
    // Where several walls meet, a point may lie on neither side of the wall of the cell.
    const auto crossingOf = [&](const unsigned int corner, const double sign) {
      return crossings[corner].numberOfLines > 0.0
               ? crossings[corner]
               : m_Gray->GetBoundary().Find(gray,
                                            points.corners[corner],
                                            { { sign * (b[0] - a[0]), sign * (b[1] - a[1]), sign * (b[2] - a[2]) } });
    };
    const Crossing lower = crossingOf(ends.lower, 1.0);
    const Crossing upper = crossingOf(ends.upper, -1.0);
    const double   cosine =
      (lower.normal[0] * upper.normal[0] + lower.normal[1] * upper.normal[1]) + lower.normal[2] * upper.normal[2];
    if (std::min(lower.numberOfLines, upper.numberOfLines) > 0.0 && cosine < SameSide)
    {
      fit.AddTangents(tangentOf(lower), tangentOf(upper));
    }
    else
    {
      fit.AddPair(a, b);
    }
  });
}

/** A voxel as a position relative to the center of a cell. */
MedialVoxelSurfaceFit::PointType
MedialVoxelSurfaceCells::FromCenter(const MedialVoxelIndex & index, const MedialVoxelIndex & voxel) const
{
  MedialVoxelSurfaceFit::PointType result;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    result[axis] = (static_cast<double>(voxel[axis] - index[axis]) - 0.5) * m_PhysicalGrid.GetSpacing()[axis];
  }
  return result;
}

} // end namespace itk
