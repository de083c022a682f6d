// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Bounds of the cells of a tile, while and after they are decided.

#include "itkMedialVoxelJointClassifier.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace itk
{

namespace
{

/** Longest edges from the points of a cell to the points of most edges of voxels around it. */
constexpr double EdgesOfBoundMargin = 1.0;

} // namespace

/** A cell of the tile that is not trivial, or null. */
auto
MedialVoxelJointClassifier::FindCell(const Workspace & workspace, const MedialVoxelIndex & cell) -> const Cell *
{
  const MedialVoxelRankedBits & ranks = workspace.m_Ranks;
  const MedialVoxelBits &       bits = ranks.GetBits();
  if (!bits.GetBox().Contains(cell))
  {
    return nullptr;
  }
  const std::int64_t word = (cell[0] >> 6) - bits.GetFirstWord();
  const auto         bit = MedialVoxelBits::WordType{ 1 } << (cell[0] & 63);
  if ((bits.GetRow(cell[1], cell[2])[word] & bit) == 0)
  {
    return nullptr;
  }
  const Cell * const found = workspace.m_Cells.data() + ranks.RankOf(word, cell[1], cell[2], bit);
#if defined(__GNUC__)
  // Cells are requested in their order, but processors do not prefetch them.
  constexpr std::ptrdiff_t ahead = 8;
  __builtin_prefetch(found + ahead);
  __builtin_prefetch(reinterpret_cast<const char *>(found + ahead) + 64);
#endif
  return found;
}

bool
MedialVoxelJointClassifier::GetPair(const Workspace &        workspace,
                                    const MedialVoxelIndex & cell,
                                    MedialVoxelIndex &       a,
                                    MedialVoxelIndex &       b)
{
  const Cell * const known = FindCell(workspace, cell);
  if (known != nullptr)
  {
    a = known->a;
    b = known->b;
  }
  return known != nullptr;
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

/** An upper bound of the difference of the geodesic distances of two pairs: edges between their points. */
double
MedialVoxelJointClassifier::PathLengthTo(const MedialVoxelIndex & a,
                                         const MedialVoxelIndex & b,
                                         const Cell &             cell) const
{
  const double straight = this->EdgeBetween(a, cell.a) + this->EdgeBetween(b, cell.b);
  const double crossed = this->EdgeBetween(a, cell.b) + this->EdgeBetween(b, cell.a);
  return std::min(straight, crossed);
}

/** Length by which the bounds of cells must exceed their thresholds, so that they decide pairs of edges for observers
 * too. */
double
MedialVoxelJointClassifier::GetBoundMargin(const MedialVoxelTileInput &  input,
                                           const MedialVoxelTileLabels & labels) const
{
  return labels.GetTile().Contains(input.cells) ? 0.0 : EdgesOfBoundMargin * m_Grid.GetLongestEdge();
}

/** An upper bound of the threshold of a cell with a ball of \a radius or 0. */
double
MedialVoxelJointClassifier::GetLargestEpsilon(const MedialVoxelIndex & cell,
                                              const double             radius,
                                              const Workspace &        workspace) const
{
  return m_Threshold.EpsilonOf(MedialVoxelLocalThreshold::GetLargestRadius(cell, radius, workspace.m_Threshold));
}

/** Widen the limits of the threshold of a pair by the thresholds of the cells around its edge. */
void
MedialVoxelJointClassifier::LimitThresholds(const Workspace &           workspace,
                                            const MedialVoxelFeatures & features,
                                            const CellsOfEdge &         around,
                                            const KnownCells &          known,
                                            CrossedPair &               pair) const
{
  const MedialVoxelBox & tile = workspace.m_Ranks.GetBits().GetBox();
  double                 least = 0.0;
  for (unsigned int i = 0; i < around.number; ++i)
  {
    const Cell * const cell = known[i];
    if (cell != nullptr && cell->limit < Unlimited)
    {
      least = std::max(least, cell->radius);
      pair.mostEpsilon = std::max(pair.mostEpsilon, cell->limit);
      continue;
    }
    const MedialVoxelIndex & index = around.cells[i];
    double                   radius = 0.0;
    if (cell != nullptr)
    {
      radius = cell->radius;
    }
    else if (!tile.Contains(index))
    {
      radius = m_Threshold.FindRadius(features, index);
    }
    least = std::max(least, radius);
    pair.mostEpsilon = std::max(pair.mostEpsilon, this->GetLargestEpsilon(index, radius, workspace));
  }
  // Thresholds grow with radii.
  pair.leastEpsilon = std::max(pair.leastEpsilon, m_Threshold.EpsilonOf(least));
}

void
MedialVoxelJointClassifier::LookAt(const Workspace &           workspace,
                                   const MedialVoxelFeatures & features,
                                   const CellsOfEdge &         around,
                                   CrossedPair &               pair) const
{
  KnownCells known{};
  for (unsigned int i = 0; i < around.number; ++i)
  {
    known[i] = FindCell(workspace, around.cells[i]);
  }
  if (m_Parameters.mode == MedialVoxelThicknessMode::Automatic)
  {
    this->LimitThresholds(workspace, features, around, known, pair);
  }
  for (const Cell * const cell : known)
  {
    if (cell != nullptr)
    {
      pair.bounds.Tighten(cell->bounds, this->PathLengthTo(pair.a, pair.b, *cell));
      if (pair.bounds.Reach(pair.mostEpsilon) || pair.bounds.FallShortOf(pair.leastEpsilon))
      {
        return;
      }
    }
  }
}

/** Length of the shortest path of two edges between two boundary points; infinite when there is none. */
double
MedialVoxelJointClassifier::TwoEdgesBetween(const MedialVoxelBits &  sites,
                                            const MedialVoxelIndex & a,
                                            const MedialVoxelIndex & b) const
{
  MedialVoxelBox middles;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    middles.lower[axis] = std::max(a[axis], b[axis]) - 1;
    middles.upper[axis] = std::min(a[axis], b[axis]) + 2;
  }
  middles = middles.Intersection(sites.GetBox());
  double shortest = std::numeric_limits<double>::infinity();
  for (std::int64_t z = middles.lower[2]; z < middles.upper[2]; ++z)
  {
    for (std::int64_t y = middles.lower[1]; y < middles.upper[1]; ++y)
    {
      const auto inBox = MedialVoxelBits::RangeMask(0, 0, middles.Extent(0));
      for (auto rest = sites.Extract(middles.lower[0], y, z) & inBox; rest != 0; rest &= rest - 1)
      {
        const MedialVoxelIndex middle{ { middles.lower[0] + MedialVoxelLowestBit(rest), y, z } };
        shortest = std::min(shortest, this->EdgeBetween(a, middle) + this->EdgeBetween(middle, b));
      }
    }
  }
  return shortest;
}

/** PathLengthTo() with up to two edges from each of the points; infinite when it exceeds \a most. */
double
MedialVoxelJointClassifier::LongerPathLengthTo(const MedialVoxelBits & sites,
                                               const Cell &            from,
                                               const Cell &            to,
                                               const double            most) const
{
  const auto between = [&](const MedialVoxelIndex & i, const MedialVoxelIndex & j) {
    return std::min(this->EdgeBetween(i, j), this->TwoEdgesBetween(sites, i, j));
  };
  for (const bool isCrossed : { false, true })
  {
    double length = between(from.a, isCrossed ? to.b : to.a);
    if (length <= most)
    {
      length += between(from.b, isCrossed ? to.a : to.b);
    }
    if (length <= most)
    {
      return length;
    }
  }
  return std::numeric_limits<double>::infinity();
}

/** Tighten the bounds of a cell by the bounds of its neighbors, until they decide it. */
void
MedialVoxelJointClassifier::FollowNeighbors(const Workspace &       workspace,
                                            const MedialVoxelBits & sites,
                                            const NeighborReach     reach,
                                            const double            epsilon,
                                            Cell &                  cell) const
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
      const auto inRow = bits.Extract(x - 1, y, z) & 7u;
      if (inRow == 0)
      {
        continue;
      }
      // The cells of a row follow each other.
      std::size_t next = workspace.m_Ranks.RankOf({ { x - 1 + MedialVoxelLowestBit(inRow), y, z } });
      for (auto rest = inRow; rest != 0; rest &= rest - 1)
      {
        const Cell & neighbor = workspace.m_Cells[next++];
        const double most = std::max(neighbor.bounds.shortest - epsilon, epsilon - neighbor.bounds.longest);
        if (most <= 0.0)
        {
          continue;
        }
        const double length = reach == NeighborReach::OneEdge ? this->PathLengthTo(cell.a, cell.b, neighbor)
                                                              : this->LongerPathLengthTo(sites, cell, neighbor, most);
        cell.bounds.Tighten(neighbor.bounds, length);
        if (cell.bounds.FallShortOf(epsilon) || cell.bounds.Reach(epsilon))
        {
          return;
        }
      }
    }
  }
}

} // end namespace itk
