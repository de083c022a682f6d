// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLocalThreshold.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace itk
{

MedialVoxelLocalThreshold::MedialVoxelLocalThreshold(const MedialVoxelGrid &       grid,
                                                     const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Pairs(grid, parameters.epsilon)
  , m_Cover(grid)
  , m_Unit(grid.GetMetricUnit())
{}

MedialVoxelIndex
MedialVoxelLocalThreshold::GetReach() const
{
  return m_Grid.MarginForMetricLength(m_Parameters.largestRadius / m_Unit);
}

MedialVoxelIndex
MedialVoxelLocalThreshold::GetMargin() const
{
  MedialVoxelIndex       margin = this->GetReach();
  const MedialVoxelIndex one = m_Grid.GetUnitMargin();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    margin[axis] += one[axis];
  }
  return margin;
}

MedialVoxelBox
MedialVoxelLocalThreshold::GetCellBox(const MedialVoxelBox & cells) const
{
  return cells.Expanded(this->GetReach()).Intersection(m_Grid.GetCellBox());
}

double
MedialVoxelLocalThreshold::RadiusOf(const MedialVoxelDiagonal & widest) const
{
  const MedialVoxelPair & pair = widest.pair;
  if (std::abs(pair.difference[0]) <= 1 && std::abs(pair.difference[1]) <= 1 && std::abs(pair.difference[2]) <= 1)
  {
    return 0.0;
  }
  const MedialVoxelDualCell & cell = m_Pairs.GetCell();
  const auto                  distance = [&](const unsigned int corner, const MedialVoxelDisplacement & displacement) {
    const MedialVoxelDisplacement & offset = cell.GetCorner(corner);
    std::array<double, 3>           way;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double center = m_Grid.IsActive(axis) ? 0.5 : 0.0;
      way[axis] = (static_cast<double>(offset[axis] + displacement[axis]) - center) * m_Grid.GetMetricSpacing()[axis];
    }
    return std::sqrt((way[0] * way[0] + way[1] * way[1]) + way[2] * way[2]);
  };
  return 0.5 * (distance(widest.number, pair.displacement) +
                distance(cell.GetOppositeCorner(widest.number), pair.oppositeDisplacement));
}

double
MedialVoxelLocalThreshold::EpsilonOf(const double radius) const
{
  return std::max(m_Parameters.epsilon,
                  m_Parameters.thicknessFactor * std::min(radius * m_Unit, m_Parameters.largestRadius));
}

void
MedialVoxelLocalThreshold::Compute(const MedialVoxelBits &     corners,
                                   const MedialVoxelFeatures & features,
                                   Workspace &                 workspace) const
{
  const MedialVoxelBits & asked = workspace.cells.GetBits();
  workspace.balls.clear();
  workspace.radii.assign(workspace.cells.GetNumberOfBits(), 0.0);
  MedialVoxelPollCounter poll;
  m_Pairs.Visit(corners, features, this->GetCellBox(asked.GetBox()), [&](const MedialVoxelCells & cells) {
    poll.Count(static_cast<std::uint32_t>(cells.number));
    for (auto rest = m_Pairs.Spread(cells); rest != 0; rest &= rest - 1)
    {
      const int              x = MedialVoxelLowestBit(rest);
      MedialVoxelDiagonal    widest;
      const double           radius = m_Pairs.Choose(features, cells, x, widest) ? this->RadiusOf(widest) : 0.0;
      const MedialVoxelIndex cell{ { cells.first[0] + x, cells.first[1], cells.first[2] } };
      if (this->CanRaise(radius))
      {
        workspace.balls.push_back({ cell, radius });
      }
      if (asked.GetBox().Contains(cell) && asked.Test(cell))
      {
        workspace.radii[workspace.cells.RankOf(cell)] = radius;
      }
    }
    return true;
  });
  this->SurveyBalls(asked.GetBox(), workspace);
  this->RaiseRadii(workspace);
}

} // end namespace itk
