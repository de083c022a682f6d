// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestAutomatic_h
#define MedialVoxelTestAutomatic_h

// The automatic thickness by brute force: every cell against every ball, and plain Dijkstra.

#include "MedialVoxelTestClassification.h"

namespace MedialVoxelTest
{
/** What a user chooses, in physical units. */
struct WallLimits
{
  double minimum;
  double maximum;
  double factor{ 3.0 };
};

class JointClassifier
{
public:
  JointClassifier(const Volume & volume, const WallLimits & limits)
    : m_Volume(volume)
    , m_Limits(limits)
    , m_Sites(BoundarySites(volume))
    , m_Nearest(NearestBoundaryPoints(volume, m_Sites))
    , m_Graph(volume, m_Sites)
  {
    for (std::size_t i = 0; i < volume.object.size(); ++i)
    {
      const Index3 cell = volume.IndexAt(i);
      if (IsCandidate(volume, cell))
      {
        m_Pairs[i] = ChoosePair(volume, m_Sites, m_Nearest, cell);
        m_Radii[i] = this->RadiusOf(cell, m_Pairs[i]);
      }
    }
  }

  /** epsilon(p) of the cell at a candidate. */
  double
  EpsilonOf(std::size_t cell) const
  {
    const double unit = this->MetricUnit();
    double       largest = m_Radii.at(cell);
    for (const auto & ball : m_Radii)
    {
      const double distance = KeyDistance(m_Volume, m_Volume.IndexAt(ball.first), m_Volume.IndexAt(cell));
      if (ball.second * unit <= m_Limits.maximum / 2 && distance <= ball.second * ball.second)
      {
        largest = std::max(largest, ball.second);
      }
    }
    return std::max(MedialVoxelTest::EpsilonOf(m_Limits.minimum),
                    m_Limits.factor * std::min(largest * unit, m_Limits.maximum / 2));
  }

  Classification
  Run(Bound bound)
  {
    Classification result;
    result.labels.assign(m_Volume.object.size(), 0);
    result.counts.objectVoxels =
      static_cast<std::uint64_t>(std::count(m_Volume.object.begin(), m_Volume.object.end(), 1));
    result.counts.boundaryVoxels = m_Sites.size();
    result.counts.candidateCells = m_Pairs.size();
    for (const auto & entry : m_Pairs)
    {
      result.labels[entry.first] = this->LabelOf(entry.first, entry.second, bound, result.counts);
    }
    return result;
  }

  /** Between two sites; anything above all thresholds may come back as infinite. */
  double
  GeodesicDistance(long from, long to)
  {
    auto found = m_DistancesFrom.find(from);
    if (found == m_DistancesFrom.end())
    {
      const double limit = m_Limits.factor * m_Limits.maximum + MedialVoxelTest::EpsilonOf(m_Limits.minimum);
      found = m_DistancesFrom.emplace(from, m_Graph.DistancesFrom(static_cast<int>(from), limit)).first;
    }
    return found->second[to];
  }

private:
  double
  MetricUnit() const
  {
    const auto axes = m_Volume.Axes();
    return m_Volume.HasEqualSpacing() && !axes.empty() ? m_Volume.spacing[axes[0]] : 1.0;
  }

  double
  RadiusOf(const Index3 & cell, const Pair & pair) const
  {
    if (!pair.defined)
    {
      return 0.0;
    }
    const Index3 & a = m_Sites[pair.ni];
    const Index3 & b = m_Sites[pair.nj];
    int            farthest = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      farthest = std::max(farthest, std::abs(a[axis] - b[axis]));
    }
    return farthest <= 1 ? 0.0 : 0.5 * (this->DistanceFromCenter(cell, a) + this->DistanceFromCenter(cell, b));
  }

  double
  DistanceFromCenter(const Index3 & cell, const Index3 & point) const
  {
    Vector3 way{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const double center = cell[axis] + (m_Volume.size[axis] > 1 ? 0.5 : 0.0);
      way[axis] = (point[axis] - center) * (m_Volume.HasEqualSpacing() ? 1.0 : m_Volume.spacing[axis]);
    }
    return std::sqrt((way[0] * way[0] + way[1] * way[1]) + way[2] * way[2]);
  }

  unsigned char
  LabelOf(std::size_t cell, const Pair & pair, Bound bound, Counts & counts)
  {
    if (!pair.defined)
    {
      ++counts.trivialCells;
      return 1;
    }
    const double   epsilon = this->EpsilonOf(cell);
    const Index3 & a = m_Sites[pair.ni];
    const Index3 & b = m_Sites[pair.nj];
    if (IsTrivialPair(m_Volume, a, b, epsilon))
    {
      ++counts.trivialCells;
      return 1;
    }
    const bool isBounded = (bound == Bound::FreeSpace && FreeSpaceLength(m_Volume, a, b) >= epsilon) ||
                           (bound == Bound::Paper && PaperPseudoGeodesic(m_Volume, pair.vi, a, pair.vj, b) >= epsilon);
    if (isBounded)
    {
      ++counts.boundCells;
      return 2;
    }
    const double geodesic = this->GeodesicDistance(pair.ni, pair.nj);
    if (std::abs(geodesic - epsilon) < 1e-9 * epsilon)
    {
      throw std::logic_error("a path length within 1e-9 of a threshold");
    }
    ++(geodesic >= epsilon ? counts.geodesicMedialCells : counts.geodesicNonMedialCells);
    return geodesic >= epsilon ? 3 : 1;
  }

  const Volume &                      m_Volume;
  WallLimits                          m_Limits;
  std::vector<Index3>                 m_Sites;
  std::vector<long>                   m_Nearest;
  BoundaryGraph                       m_Graph;
  std::map<std::size_t, Pair>         m_Pairs;
  std::map<std::size_t, double>       m_Radii;
  std::map<long, std::vector<double>> m_DistancesFrom;
};
} // namespace MedialVoxelTest

#endif // MedialVoxelTestAutomatic_h
