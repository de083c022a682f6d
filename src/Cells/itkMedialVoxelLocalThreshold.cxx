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
MedialVoxelLocalThreshold::Compute(const MedialVoxelBits &     object,
                                   const MedialVoxelFeatures & features,
                                   const MedialVoxelBox &      box,
                                   Workspace &                 workspace,
                                   std::vector<double> &       epsilons) const
{
  workspace.balls.clear();
  workspace.radii.clear();
  workspace.offsets.clear();
  workspace.cells.Reshape(box);
  MedialVoxelPollCounter poll;
  m_Pairs.Visit(object, features, this->GetCellBox(box), [&](const MedialVoxelCells & cells) {
    poll.Count(static_cast<std::uint32_t>(cells.number));
    const auto spread = m_Pairs.Spread(cells);
    for (auto rest = cells.candidates; rest != 0; rest &= rest - 1)
    {
      const int              x = MedialVoxelLowestBit(rest);
      const MedialVoxelIndex cell{ { cells.first[0] + x, cells.first[1], cells.first[2] } };
      MedialVoxelDiagonal    widest;
      const bool             hasPair = ((spread >> x) & 1u) != 0 && m_Pairs.Choose(features, cells, x, widest);
      const double           radius = hasPair ? this->RadiusOf(widest) : 0.0;
      if (this->CanRaise(radius))
      {
        workspace.balls.push_back({ cell, radius });
      }
      if (box.Contains(cell))
      {
        workspace.cells.Set(cell);
        workspace.offsets.push_back(box.OffsetOf(cell));
        workspace.radii.push_back(radius);
      }
    }
    return true;
  });
  workspace.cells.Rank();
  this->RaiseRadii(workspace);
  epsilons.assign(static_cast<std::size_t>(box.NumberOfVoxels()), m_Parameters.epsilon);
  for (std::size_t i = 0; i < workspace.offsets.size(); ++i)
  {
    epsilons[workspace.offsets[i]] = this->EpsilonOf(workspace.radii[i]);
  }
}

} // end namespace itk
