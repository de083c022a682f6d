// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLocalThreshold.h"

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
MedialVoxelLocalThreshold::EpsilonOf(const double ownRadius, const double coveringRadius) const
{
  const double thickness = std::max(ownRadius, coveringRadius) * m_Unit;
  return std::max(m_Parameters.epsilon, m_Parameters.thicknessFactor * std::min(thickness, m_Parameters.largestRadius));
}

void
MedialVoxelLocalThreshold::Compute(const MedialVoxelBits &     object,
                                   const MedialVoxelFeatures & features,
                                   const MedialVoxelBox &      box,
                                   Workspace &                 workspace,
                                   std::vector<double> &       epsilons) const
{
  epsilons.assign(static_cast<std::size_t>(box.NumberOfVoxels()), m_Parameters.epsilon);
  workspace.balls.clear();
  MedialVoxelBits & asked = workspace.cells.Reshape(box);
  workspace.ownRadii.assign(epsilons.size(), 0.0);
  const auto offsetOf = [&](const MedialVoxelIndex & cell) {
    return static_cast<std::size_t>(
      ((cell[2] - box.lower[2]) * box.Extent(1) + (cell[1] - box.lower[1])) * box.Extent(0) + (cell[0] - box.lower[0]));
  };
  m_Pairs.Visit(object, features, this->GetCellBox(box), [&](const MedialVoxelCells & cells) {
    const auto spread = m_Pairs.Spread(cells);
    for (auto rest = cells.candidates; rest != 0; rest &= rest - 1)
    {
      const int              x = MedialVoxelLowestBit(rest);
      const MedialVoxelIndex cell{ { cells.first[0] + x, cells.first[1], cells.first[2] } };
      const bool             isAsked = box.Contains(cell);
      if (isAsked)
      {
        asked.Set(cell);
      }
      MedialVoxelDiagonal widest;
      if (((spread >> x) & 1u) == 0 || !m_Pairs.Choose(features, cells, x, widest))
      {
        continue;
      }
      const double radius = this->RadiusOf(widest);
      if (isAsked)
      {
        workspace.ownRadii[offsetOf(cell)] = radius;
      }
      if (this->CanRaise(radius))
      {
        workspace.balls.push_back({ cell, radius });
      }
    }
    return true;
  });
  workspace.cells.Rank();
  m_Cover.Cover(workspace.balls, workspace.cells, workspace.cover, workspace.coveringRadii);
  std::size_t position = 0;
  m_Pairs.Visit(object, features, box, [&](const MedialVoxelCells & cells) {
    for (auto rest = cells.candidates; rest != 0; rest &= rest - 1)
    {
      const MedialVoxelIndex cell{ { cells.first[0] + MedialVoxelLowestBit(rest), cells.first[1], cells.first[2] } };
      const std::size_t      offset = offsetOf(cell);
      epsilons[offset] = this->EpsilonOf(workspace.ownRadii[offset], workspace.coveringRadii[position++]);
    }
    return true;
  });
}

} // end namespace itk
