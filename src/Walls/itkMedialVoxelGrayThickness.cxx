// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayThickness.h"

#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using PositionType = MedialVoxelGrayBoundary::PositionType;
using Crossing = MedialVoxelGrayBoundary::Crossing;

/** Adds a crossing to the sums of its side, once for each line that found it. */
void
AddTo(Crossing & side, const Crossing & crossing)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    side.position[axis] += crossing.numberOfLines * crossing.position[axis];
    side.normal[axis] += crossing.numberOfLines * crossing.normal[axis];
  }
  side.isRising = side.numberOfLines > 0.0 ? side.isRising : crossing.isRising;
  side.numberOfLines += crossing.numberOfLines;
}

/** Walls of more voxels are measured by their surfaces. */
constexpr double ThickestFitted = 6.0;

/** Cosine of two directions from which they no longer belong to the same wall. */
constexpr double SameDirection = 0.8;

/** Voxels around the boundary points that the fit of a surface may need. */
constexpr auto ReachOfPoints = static_cast<std::int64_t>(MedialVoxelWallFit::ReachOfSurface) + 4;

/** Standard deviations in an interval of 95 %, to each side; of the place between the voxels, and of the levels for
 * each voxel of thickness. */
constexpr double Quantile = 1.96;
constexpr double DeviationOfPlace = 0.03;
constexpr double DeviationOfLevels = 0.01;

PositionType
Along(const PositionType & start, const PositionType & line, const double times)
{
  return { { start[0] + times * line[0], start[1] + times * line[1], start[2] + times * line[2] } };
}

PositionType
Normalized(const PositionType & vector)
{
  const double length = MedialVoxelNorm(vector);
  return { { vector[0] / length, vector[1] / length, vector[2] / length } };
}

} // namespace

struct MedialVoxelGrayThickness::Sides
{
  PositionType means[2];
  PositionType direction; // from the first to the second, of length 1
  double       thickness; // about
};

struct MedialVoxelGrayThickness::Fitted
{
  PositionType normal;
  double       thickness;
  double       deviation;
  bool         isResolved;
};

MedialVoxelGrayThickness::MedialVoxelGrayThickness(const MedialVoxelGrid &              grid,
                                                   const double                         lower,
                                                   const double                         upper,
                                                   const std::optional<MedialVoxelScan> scan)
  : m_Grid(grid)
  , m_Boundary(grid, lower, upper)
  , m_Smallest(MedialVoxelThickness(grid).GetSmallest())
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_CellVolume *= grid.IsActive(axis) ? grid.GetSpacing()[axis] : 1.0;
  }
  const unsigned int axes = grid.GetNumberOfActiveAxes();
  if (scan && axes > 1)
  {
    m_Model.emplace(
      Model{ *scan, MedialVoxelGrayLocal(grid, scan->background, scan->material), MedialVoxelWallFit(*scan, axes) });
  }
}

MedialVoxelBox
MedialVoxelGrayThickness::GetBoxAround(const MedialVoxelWallPoints & points, const std::int64_t reach)
{
  MedialVoxelBox box;
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    box = box.Union({ point, { { point[0] + 1, point[1] + 1, point[2] + 1 } } });
  }
  return box.Expanded({ { reach, reach, reach } });
}

MedialVoxelBox
MedialVoxelGrayThickness::GetReadBox(const MedialVoxelWallPoints & points) const
{
  if (!m_Model)
  {
    return GetBoxAround(points, MedialVoxelGrayBoundary::Reach).Intersection(m_Grid.GetVoxelBox());
  }
  const MedialVoxelIndex & cell = points.cell;
  const MedialVoxelBox     voxel{ cell, { { cell[0] + 1, cell[1] + 1, cell[2] + 1 } } };
  return GetBoxAround(points, ReachOfPoints)
    .Union(voxel.Expanded({ { Reach, Reach, Reach } }))
    .Intersection(m_Grid.GetVoxelBox());
}

auto
MedialVoxelGrayThickness::FindCrossings(const MedialVoxelGray & gray, const MedialVoxelWallPoints & points) const
  -> Crossings
{
  const PositionType fromA = this->GetDirection(points);
  const PositionType fromB{ { -fromA[0], -fromA[1], -fromA[2] } };
  const auto         sideOf = points.GetNearerSides();
  Crossings          crossings;
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    if (sideOf[corner] == 2)
    {
      continue;
    }
    // Corners of a cell mostly share their boundary points.
    unsigned int first = 0;
    while (points.corners[first] != points.corners[corner] || sideOf[first] == 2)
    {
      ++first;
    }
    crossings[corner] = first < corner
                          ? crossings[first]
                          : m_Boundary.Find(gray, points.corners[corner], sideOf[corner] == 0 ? fromA : fromB);
  }
  return crossings;
}

void
MedialVoxelGrayThickness::Refine(const MedialVoxelGray &       gray,
                                 const MedialVoxelWallPoints & points,
                                 Workspace &                   workspace,
                                 MedialVoxelWall &             wall) const
{
  if (!this->RefineByFit(gray, points, workspace, wall))
  {
    this->RefineByCrossings(gray, points, this->FindCrossings(gray, points), wall);
  }
}

void
MedialVoxelGrayThickness::Refine(const MedialVoxelGray &       gray,
                                 const MedialVoxelWallPoints & points,
                                 const Crossings &             crossings,
                                 Workspace &                   workspace,
                                 MedialVoxelWall &             wall) const
{
  if (!this->RefineByFit(gray, points, workspace, wall))
  {
    this->RefineByCrossings(gray, points, crossings, wall);
  }
}

void
MedialVoxelGrayThickness::RefineByCrossings(const MedialVoxelGray &       gray,
                                            const MedialVoxelWallPoints & points,
                                            const Crossings &             crossings,
                                            MedialVoxelWall &             wall) const
{
  const auto sideOf = points.GetNearerSides();
  Crossing   sides[2];
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const unsigned int side = sideOf[corner];
    if (side < 2)
    {
      AddTo(sides[side], crossings[corner]);
    }
  }
  if (sides[0].numberOfLines == 0.0 || sides[1].numberOfLines == 0.0)
  {
    return;
  }
  // The normals of both sides point into the wall.
  PositionType normal;
  PositionType center = this->GetCenter(points);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = sides[0].normal[axis] / sides[0].numberOfLines - sides[1].normal[axis] / sides[1].numberOfLines;
    center[axis] *= m_Grid.GetSpacing()[axis];
  }
  const double length = MedialVoxelNorm(normal);
  double       extent = 0.0; // of a cell along the normal
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    normal[axis] /= length;
    extent += std::abs(normal[axis]) * m_Grid.GetSpacing()[axis];
  }
  double thickness = 0.0;
  for (Crossing & side : sides)
  {
    const double sign = &side == &sides[0] ? 1.0 : -1.0;
    double       position = sign * MedialVoxelDot(side.position, normal) / side.numberOfLines;
    PositionType foot;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      foot[axis] = center[axis] + (sign * position - MedialVoxelDot(center, normal)) * normal[axis];
      side.normal[axis] = sign * normal[axis];
    }
    m_Boundary.FindAround(gray, GetBoxAround(points, MedialVoxelGrayBoundary::Reach), foot, side, position);
    thickness -= position;
  }
  if (thickness > 0.0)
  {
    wall.thickness = static_cast<float>(std::max(m_Smallest, thickness));
    wall.area = static_cast<float>(m_CellVolume / extent);
  }
}

bool
MedialVoxelGrayThickness::RefineByFit(const MedialVoxelGray &       gray,
                                      const MedialVoxelWallPoints & points,
                                      Workspace &                   workspace,
                                      MedialVoxelWall &             wall) const
{
  if (!m_Model || wall.isUnpaired)
  {
    return false;
  }
  if (!workspace.normals)
  {
    workspace.normals.emplace(m_Grid, m_Model->scan.background, m_Model->scan.material);
  }
  const Sides                 sides = GetSides(points);
  const std::optional<Fitted> fitted = sides.thickness <= ThickestFitted
                                         ? this->FitWall(gray, points, sides, workspace)
                                         : this->FitSurfaces(gray, points, sides, workspace);
  if (!fitted)
  {
    return false;
  }
  // Planes that are a voxel apart, in voxels, have this distance in the units of the spacing.
  PositionType normal;
  double       extent = 0.0; // of a cell along the normal
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = fitted->normal[axis] / m_Grid.GetSpacing()[axis];
  }
  const double scale = 1.0 / MedialVoxelNorm(normal);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    extent += std::abs(normal[axis]) * scale * (m_Grid.IsActive(axis) ? m_Grid.GetSpacing()[axis] : 0.0);
  }
  const double ofLevels = DeviationOfLevels * fitted->thickness;
  const double deviation =
    std::sqrt((fitted->deviation * fitted->deviation + DeviationOfPlace * DeviationOfPlace) + ofLevels * ofLevels);
  wall.thickness = static_cast<float>(std::max(m_Smallest, scale * fitted->thickness));
  wall.area = static_cast<float>(m_CellVolume / extent);
  wall.isUnresolved = !fitted->isResolved;
  wall.uncertainty =
    fitted->isResolved ? static_cast<float>(scale * Quantile * deviation) : std::numeric_limits<float>::quiet_NaN();
  return true;
}

/** Whether planes with a normal, in voxels, lie across the line between both sides, in the units of the spacing. */
bool
MedialVoxelGrayThickness::LeadsAcross(const PositionType & normal, const Sides & sides) const
{
  PositionType across;
  PositionType between;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    across[axis] = normal[axis] / m_Grid.GetSpacing()[axis];
    between[axis] = sides.direction[axis] * m_Grid.GetSpacing()[axis];
  }
  return std::abs(MedialVoxelDot(across, between)) >=
         SameDirection * MedialVoxelNorm(across) * MedialVoxelNorm(between);
}

/** Along the direction in which the values around the cell change most. */
auto
MedialVoxelGrayThickness::FitWall(const MedialVoxelGray &       gray,
                                  const MedialVoxelWallPoints & points,
                                  const Sides &                 sides,
                                  Workspace &                   workspace) const -> std::optional<Fitted>
{
  const PositionType center = this->GetCenter(points);
  Fitted             fitted{};
  if (!workspace.normals->Find(gray, center, fitted.normal) || !this->LeadsAcross(fitted.normal, sides))
  {
    return std::nullopt;
  }
  m_Model->local.FindSamples(gray, center, fitted.normal, MedialVoxelWallFit::ReachOfWall, workspace.samples);
  const auto wall = m_Model->fit.FitWall(workspace.samples);
  if (!wall)
  {
    return std::nullopt;
  }
  fitted.thickness = wall->thickness;
  fitted.deviation = wall->deviation;
  fitted.isResolved = wall->isResolved;
  return fitted;
}

/** Each along the direction in which the values around it change most. */
auto
MedialVoxelGrayThickness::FitSurfaces(const MedialVoxelGray &       gray,
                                      const MedialVoxelWallPoints & points,
                                      const Sides &                 sides,
                                      Workspace &                   workspace) const -> std::optional<Fitted>
{
  PositionType places[2];
  PositionType normals[2]; // into the wall
  double       variance = 0.0;
  for (const unsigned int side : { 0u, 1u })
  {
    const double       sign = side == 0 ? 1.0 : -1.0;
    const PositionType foot = Along(sides.means[side], sides.direction, 0.5 * sign);
    PositionType &     normal = normals[side];
    if (!workspace.normals->Find(gray, foot, normal))
    {
      return std::nullopt;
    }
    if (sign * MedialVoxelDot(normal, sides.direction) < 0.0)
    {
      normal = { { -normal[0], -normal[1], -normal[2] } };
    }
    m_Model->local.FindSamples(gray, foot, normal, MedialVoxelWallFit::ReachOfSurface, workspace.samples);
    const auto surface = m_Model->fit.FitSurface(workspace.samples);
    if (!surface)
    {
      return std::nullopt;
    }
    places[side] = Along(foot, normal, surface->place);
    variance += surface->deviation * surface->deviation;
  }
  if (MedialVoxelDot(normals[0], normals[1]) > -SameDirection)
  {
    return std::nullopt;
  }
  Fitted fitted{};
  fitted.normal = Normalized(MedialVoxelSubtract(normals[0], normals[1]));
  const PositionType center = this->GetCenter(points);
  const auto         alongNormal = [&](const unsigned int side) {
    return MedialVoxelDot(MedialVoxelSubtract(places[side], center), normals[side]) /
           MedialVoxelDot(fitted.normal, normals[side]);
  };
  fitted.thickness = alongNormal(1) - alongNormal(0);
  fitted.deviation = std::sqrt(variance);
  fitted.isResolved = true;
  return fitted.thickness > 0.0 ? std::optional<Fitted>(fitted) : std::nullopt;
}

auto
MedialVoxelGrayThickness::GetCenter(const MedialVoxelWallPoints & points) const -> PositionType
{
  PositionType center;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    center[axis] = static_cast<double>(points.cell[axis]) + (m_Grid.IsActive(axis) ? 0.5 : 0.0);
  }
  return center;
}

/** Corners of a and b belong to a side each, so that both have points. */
auto
MedialVoxelGrayThickness::GetSides(const MedialVoxelWallPoints & points) -> Sides
{
  const auto sideOf = points.GetNearerSides();
  Sides      sides{};
  double     numbers[2] = {};
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    const unsigned int       side = sideOf[corner];
    if (side < 2)
    {
      ++numbers[side];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sides.means[side][axis] += static_cast<double>(point[axis]);
      }
    }
  }
  for (const unsigned int side : { 0u, 1u })
  {
    for (double & mean : sides.means[side])
    {
      mean /= numbers[side];
    }
  }
  const PositionType between = MedialVoxelSubtract(sides.means[1], sides.means[0]);
  sides.thickness = MedialVoxelNorm(between) - 1.0;
  sides.direction = Normalized(between);
  return sides;
}

auto
MedialVoxelGrayThickness::GetDirection(const MedialVoxelWallPoints & points) const -> PositionType
{
  const auto   sideOf = points.GetNearerSides();
  PositionType sums[3] = {};
  double       numbers[3] = { 0.0, 0.0, 0.0 };
  for (unsigned int corner = 0; corner < points.numberOfCorners; ++corner)
  {
    const MedialVoxelIndex & point = points.corners[corner];
    const unsigned int       side = sideOf[corner];
    ++numbers[side];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sums[side][axis] += static_cast<double>(point[axis] - points.a[axis]) * m_Grid.GetSpacing()[axis];
    }
  }
  PositionType direction;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    direction[axis] = sums[1][axis] / numbers[1] - sums[0][axis] / numbers[0];
  }
  return direction;
}

} // end namespace itk
