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
    std::array<double, 3>           vector;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double center = m_Grid.IsActive(axis) ? 0.5 : 0.0;
      vector[axis] =
        (static_cast<double>(offset[axis] + displacement[axis]) - center) * m_Grid.GetMetricSpacing()[axis];
    }
    return std::sqrt((vector[0] * vector[0] + vector[1] * vector[1]) + vector[2] * vector[2]);
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

double
MedialVoxelLocalThreshold::FindRadius(const MedialVoxelFeatures & features, const MedialVoxelIndex & cell) const
{
  MedialVoxelDiagonal widest;
  return m_Pairs.Choose(features, m_Pairs.CellAt(features, cell), 0, widest) ? this->RadiusOf(widest) : 0.0;
}

void
MedialVoxelLocalThreshold::FindRadii(const MedialVoxelFeatures & features, Workspace & workspace) const
{
  const MedialVoxelBits & cells = workspace.cells.GetBits();
  const MedialVoxelBox &  box = cells.GetBox();
  workspace.radii.clear();
  MedialVoxelAbortChecker checker;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const MedialVoxelBits::WordType * const row = cells.GetRow(y, z);
      for (std::int64_t i = 0; i < cells.GetWordsPerRow(); ++i)
      {
        checker.Count();
        const std::int64_t x = (cells.GetFirstWord() + i) * MedialVoxelBits::BitsPerWord;
        for (auto rest = row[i]; rest != 0; rest &= rest - 1)
        {
          workspace.radii.push_back(this->FindRadius(features, { { x + MedialVoxelLowestBit(rest), y, z } }));
        }
      }
    }
  }
}

void
MedialVoxelLocalThreshold::Compute(const std::vector<MedialVoxelInscribedBall> & balls,
                                   const MedialVoxelFeatures &                   features,
                                   Workspace &                                   workspace) const
{
  this->FindRadii(features, workspace);
  m_Cover.Survey(workspace.cells.GetBits().GetBox(), balls, workspace.cover);
  m_Cover.Raise(balls, workspace.cells, workspace.cover, workspace.radii);
}

} // end namespace itk
