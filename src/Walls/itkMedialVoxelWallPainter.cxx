// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallPainter.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

/** A ball takes as long as so many short steps. */
constexpr std::uint32_t StepsOfBall = 64;

/** Balls between two tests whether all voxels are painted. */
constexpr std::size_t BallsBetweenLooks = 4096;

} // namespace

MedialVoxelWallPainter::MedialVoxelWallPainter(const MedialVoxelGrid & grid, const double maximumRadius)
  : m_Grid(grid)
  , m_Margin(grid.MarginForMetricLength(maximumRadius / grid.GetMetricUnit()))
{
  assert(maximumRadius > 0.0 && std::isfinite(maximumRadius));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_Center[axis] = grid.IsActive(axis) ? 0.5 : 0.0;
    // The center of a cell is half a voxel above its index.
    m_Margin[axis] += grid.IsActive(axis) ? 1 : 0;
  }
}

double
MedialVoxelWallPainter::SquareOf(double x, double y, double z) const
{
  const MedialVoxelGrid::SpacingType & spacing = m_Grid.GetMetricSpacing();
  x *= spacing[0];
  y *= spacing[1];
  z *= spacing[2];
  return (x * x + y * y) + z * z;
}

void
MedialVoxelWallPainter::Paint(const MedialVoxelBox &  tile,
                              const MedialVoxelBits & object,
                              Workspace &             workspace,
                              std::vector<float> &    thickness) const
{
  workspace.open.Open(tile, object, thickness);
  std::sort(workspace.balls.begin(), workspace.balls.end(), [](const Ball & a, const Ball & b) {
    return a.radius > b.radius || (a.radius == b.radius && a.thickness > b.thickness);
  });
  MedialVoxelAbortChecker checker;
  for (std::size_t i = 0; i < workspace.balls.size(); ++i)
  {
    if (i % BallsBetweenLooks == 0 && workspace.open.IsDone())
    {
      return;
    }
    checker.Count(StepsOfBall);
    this->PaintBall(workspace.balls[i], workspace.open);
  }
  workspace.open.CloseRest(std::numeric_limits<float>::quiet_NaN());
}

void
MedialVoxelWallPainter::PaintBall(const Ball & ball, MedialVoxelOpenVoxels & open) const
{
  const double   square = ball.radius * ball.radius;
  MedialVoxelBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto reach = static_cast<std::int64_t>(ball.radius / m_Grid.GetMetricSpacing()[axis] + m_Center[axis]);
    box.lower[axis] = ball.cell[axis] - reach;
    box.upper[axis] = ball.cell[axis] + reach + 2;
  }
  // Along a row, balls cover as many voxels on both sides of their centers.
  const std::int64_t atCenter = m_Grid.IsActive(0) ? 1 : 0;
  const std::int64_t none = atCenter - 1;
  open.CloseBall(box, ball.thickness, [&](const std::int64_t rowY, const std::int64_t rowZ) {
    const double y = static_cast<double>(rowY - ball.cell[1]) - m_Center[1];
    const double z = static_cast<double>(rowZ - ball.cell[2]) - m_Center[2];
    const auto   isCovered = [&](const std::int64_t voxel) {
      return this->SquareOf(static_cast<double>(voxel) - m_Center[0], y, z) < square;
    };
    const double rest = square - this->SquareOf(0.0, y, z);
    std::int64_t last = none;
    if (rest > 0.0)
    {
      // Rounding is put right by the definition.
      last = static_cast<std::int64_t>(std::sqrt(rest) / m_Grid.GetMetricSpacing()[0] + m_Center[0]);
    }
    while (last > none && !isCovered(last))
    {
      --last;
    }
    while (isCovered(last + 1))
    {
      ++last;
    }
    return MedialVoxelOpenVoxels::RowRange{ ball.cell[0] + atCenter - last, ball.cell[0] + last + 1 };
  });
}

} // end namespace itk
