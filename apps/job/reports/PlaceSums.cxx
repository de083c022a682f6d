// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceSums.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

/** The members that other processes get. */
template <typename TSums, typename TNumbers>
void
Exchange(TSums & sums, TNumbers & numbers)
{
  numbers.Exchange(sums.cells);
  numbers.Exchange(sums.area);
  numbers.Exchange(sums.areaBeyond);
  numbers.Exchange(sums.thickness);
  numbers.Exchange(sums.minimum);
  numbers.Exchange(sums.maximum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    numbers.Exchange(sums.first[axis]);
    numbers.Exchange(sums.last[axis]);
  }
  PlaceCell::Exchange(sums.worst, numbers);
  numbers.Exchange(sums.hasBegun);
}

PlaceStep
GetStep(const itk::MedialVoxelIndex & from, const itk::MedialVoxelIndex & to)
{
  PlaceStep step{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    step[axis] = static_cast<std::int32_t>(to[axis] - from[axis]);
  }
  return step;
}

/** \param shift voxels along each axis that is longer than one voxel, as cells have it */
WallLocation::Point
GetPoint(const VolumeGeometry & geometry, const itk::MedialVoxelIndex & index, const PlaceStep & step, double shift)
{
  WallLocation::Point point{};
  for (unsigned int row = 0; row < geometry.GetDimension(); ++row)
  {
    point[row] = geometry.origin[row];
    for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
    {
      const double voxels = static_cast<double>(index[axis] + step[axis]) + (geometry.size[axis] > 1 ? shift : 0.0);
      point[row] += geometry.direction[axis][row] * geometry.spacing[axis] * voxels;
    }
  }
  return point;
}

/** Whether a voxel is an outermost one of the volume. */
bool
IsOutermost(const VolumeGeometry & geometry, const itk::MedialVoxelIndex & index, const PlaceStep & step)
{
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    const std::int64_t voxel = index[axis] + step[axis];
    if (geometry.size[axis] > 1 && (voxel == 0 || voxel + 1 == static_cast<std::int64_t>(geometry.size[axis])))
    {
      return true;
    }
  }
  return false;
}

} // namespace

void
TakeSides(PlaceCell & cell, const itk::MedialVoxelClassifiedTile & tile, const itk::MedialVoxelIndex & index)
{
  itk::MedialVoxelWallPoints points;
  if (tile.classifier.GetWallPoints(tile.features, index, points))
  {
    cell.a = GetStep(index, points.a);
    cell.b = GetStep(index, points.b);
  }
}

WallLocation
LocateWall(const PlaceCell & cell, const PlaceGrid & grid, const VolumeGeometry & geometry)
{
  constexpr double            halfVoxel = 0.5;
  const itk::MedialVoxelIndex index = grid.GetCell(cell.key);
  WallLocation                wall;
  if (!std::isnan(cell.uncertainty))
  {
    wall.uncertainty = static_cast<double>(cell.uncertainty);
  }
  wall.center = GetPoint(geometry, index, {}, halfVoxel);
  wall.sideA = GetPoint(geometry, index, cell.a, 0.0);
  wall.sideB = GetPoint(geometry, index, cell.b, 0.0);
  for (const PlaceStep & step : { PlaceStep{}, PlaceStep{ { 1, 1, 1 } }, cell.a, cell.b })
  {
    wall.isAtEdge = wall.isAtEdge || IsOutermost(geometry, index, step);
  }
  std::copy(index.begin(), index.end(), wall.index.begin());
  return wall;
}

void
PlaceSums::Add(const PlaceCell & cell, const PlaceRule & rule, const PlaceGrid & grid)
{
  this->TakeWorst(cell, rule);
  ++cells;
  area += cell.area;
  thickness += static_cast<std::uint64_t>(std::llround(static_cast<double>(cell.thickness) / rule.lengthUnit));
  minimum = std::min(minimum, cell.thickness);
  maximum = std::max(maximum, cell.thickness);
  const itk::MedialVoxelIndex index = grid.GetCell(cell.key);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto position = static_cast<std::int32_t>(index[axis]);
    first[axis] = std::min(first[axis], position);
    last[axis] = std::max(last[axis], position);
  }
  if (rule.Begins(cell.thickness))
  {
    hasBegun = true;
    areaBeyond += cell.area;
  }
}

void
PlaceSums::Add(const PlaceSums & other, const PlaceRule & rule)
{
  this->TakeWorst(other.worst, rule);
  cells += other.cells;
  area += other.area;
  areaBeyond += other.areaBeyond;
  thickness += other.thickness;
  minimum = std::min(minimum, other.minimum);
  maximum = std::max(maximum, other.maximum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    first[axis] = std::min(first[axis], other.first[axis]);
    last[axis] = std::max(last[axis], other.last[axis]);
  }
  hasBegun = hasBegun || other.hasBegun;
}

/** Before the sums know of the cell. */
void
PlaceSums::TakeWorst(const PlaceCell & cell, const PlaceRule & rule)
{
  if (cells == 0 || cell.IsWorse(worst, rule.kind))
  {
    worst = cell;
  }
}

void
PlaceSums::Save(NumberWriter & numbers) const
{
  Exchange(*this, numbers);
}

PlaceSums
PlaceSums::Load(NumberReader & numbers)
{
  PlaceSums sums;
  Exchange(sums, numbers);
  if (sums.cells == 0)
  {
    RefuseSaved();
  }
  return sums;
}

} // end namespace medialvoxel
