// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// What is known of the cells of a tile while and after they are decided.

#include "itkMedialVoxelJointClassifier.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace itk
{

/** A cell of the tile that is not trivial, or null. */
auto
MedialVoxelJointClassifier::FindCell(const Workspace & workspace, const MedialVoxelIndex & cell) -> const Cell *
{
  const MedialVoxelBits & bits = workspace.m_Ranks.GetBits();
  return bits.Test(cell) ? &workspace.m_Cells[workspace.m_Ranks.RankOf(cell)] : nullptr;
}

/** Length of the edge between two boundary points, 0 when they are the same; infinite when there is none. */
double
MedialVoxelJointClassifier::EdgeBetween(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const
{
  unsigned int mask = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t steps = std::abs(a[axis] - b[axis]);
    if (steps > 1)
    {
      return std::numeric_limits<double>::infinity();
    }
    mask |= static_cast<unsigned int>(steps) << axis;
  }
  return m_Grid.GetEdgeLength(mask);
}

/** At least what the geodesic distances of two pairs differ by: edges from the points of one to those of a cell. */
double
MedialVoxelJointClassifier::WayTo(const MedialVoxelIndex & a, const MedialVoxelIndex & b, const Cell & cell) const
{
  const double straight = this->EdgeBetween(a, cell.a) + this->EdgeBetween(b, cell.b);
  const double crossed = this->EdgeBetween(a, cell.b) + this->EdgeBetween(b, cell.a);
  return std::min(straight, crossed);
}

/** Widen the limits of the thresholds of a pair by those of a cell. */
void
MedialVoxelJointClassifier::LimitThresholds(const Workspace &           workspace,
                                            const MedialVoxelFeatures & features,
                                            const MedialVoxelIndex &    cell,
                                            CrossedPair &               pair) const
{
  double radius = 0.0;
  if (const Cell * const known = FindCell(workspace, cell))
  {
    radius = known->radius;
  }
  else if (!workspace.m_Ranks.GetBits().GetBox().Contains(cell))
  {
    radius = m_Threshold.FindRadius(features, cell);
  }
  const double largest = MedialVoxelLocalThreshold::GetLargestRadius(cell, radius, workspace.m_Threshold);
  pair.leastEpsilon = std::max(pair.leastEpsilon, m_Threshold.EpsilonOf(radius));
  pair.mostEpsilon = std::max(pair.mostEpsilon, m_Threshold.EpsilonOf(largest));
}

void
MedialVoxelJointClassifier::LookAt(const Workspace &                     workspace,
                                   const MedialVoxelFeatures &           features,
                                   const std::vector<MedialVoxelIndex> & cells,
                                   CrossedPair &                         pair) const
{
  if (m_Parameters.mode == MedialVoxelThicknessMode::Automatic)
  {
    for (const MedialVoxelIndex & cell : cells)
    {
      this->LimitThresholds(workspace, features, cell, pair);
    }
  }
  for (const MedialVoxelIndex & cell : cells)
  {
    if (const Cell * const known = FindCell(workspace, cell))
    {
      pair.bounds.Narrow(known->bounds, this->WayTo(pair.a, pair.b, *known));
      if (pair.bounds.Reach(pair.mostEpsilon) || pair.bounds.FallShortOf(pair.leastEpsilon))
      {
        return;
      }
    }
  }
}

/** Narrow the bounds of a cell by those of its neighbors, until they decide it. */
void
MedialVoxelJointClassifier::FollowNeighbors(const Workspace & workspace, const double epsilon, Cell & cell) const
{
  const MedialVoxelBits & bits = workspace.m_Ranks.GetBits();
  const std::int64_t      x = cell.center[0];
  for (std::int64_t z = cell.center[2] - 1; z <= cell.center[2] + 1; ++z)
  {
    for (std::int64_t y = cell.center[1] - 1; y <= cell.center[1] + 1; ++y)
    {
      if (!bits.HasRow(y, z))
      {
        continue;
      }
      for (auto rest = bits.Extract(x - 1, y, z) & 7u; rest != 0; rest &= rest - 1)
      {
        const Cell & neighbor =
          workspace.m_Cells[workspace.m_Ranks.RankOf({ { x - 1 + MedialVoxelLowestBit(rest), y, z } })];
        if (neighbor.bounds.longest < cell.bounds.longest || neighbor.bounds.shortest > epsilon)
        {
          cell.bounds.Narrow(neighbor.bounds, this->WayTo(cell.a, cell.b, neighbor));
        }
        if (cell.bounds.FallShortOf(epsilon) || cell.bounds.Reach(epsilon))
        {
          return;
        }
      }
    }
  }
}

} // end namespace itk
