// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestClassification_h
#define MedialVoxelTestClassification_h

// The classification of dual cells by brute force, on top of
// MedialVoxelTestOracles.h.

#include "MedialVoxelTestOracles.h"

namespace MedialVoxelTest
{
enum class Bound
{
  FreeSpace,
  Paper,
  Off
};

enum class PathSums
{
  Doubles, // Dijkstra with running sums; refuses to answer where a length comes
           // within 1e-9 of epsilon
  Exact    // sums over edge classes, for lengths that equal epsilon
};

/** The value of every phase counter over the whole volume. */
struct Counts
{
  std::uint64_t objectVoxels{ 0 };
  std::uint64_t boundaryVoxels{ 0 };
  std::uint64_t candidateCells{ 0 };
  std::uint64_t trivialCells{ 0 };
  std::uint64_t boundCells{ 0 };
  std::uint64_t geodesicMedialCells{ 0 };
  std::uint64_t geodesicNonMedialCells{ 0 };
};

struct Classification
{
  std::vector<unsigned char> labels;
  Counts                     counts;
};

/** The pair of definition 6: positions of two voxels and their boundary points.
 */
struct Pair
{
  bool   defined{ false };
  bool   unique{ true };
  double key{ 0.0 };
  Index3 vi{};
  Index3 vj{};
  long   ni{ -1 };
  long   nj{ -1 };
};

/** Definition 5: corner k of the cell at `cell`; bit i of k moves along the
 * i-th axis longer than one voxel. */
inline Index3
CellCorner(const Volume & volume, const Index3 & cell, int k)
{
  Index3     corner = cell;
  const auto axes = volume.Axes();
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    corner[axes[i]] += k >> i & 1;
  }
  return corner;
}

/** Whether the image holds a cell at this index: its highest corner is inside,
 * and there is an axis to cross. */
inline bool
IsCell(const Volume & volume, const Index3 & cell)
{
  const auto dimension = static_cast<int>(volume.Axes().size());
  return dimension > 0 && volume.Contains(CellCorner(volume, cell, (1 << dimension) - 1));
}

inline bool
IsCandidate(const Volume & volume, const Index3 & cell)
{
  bool any = false;
  for (int k = 0; IsCell(volume, cell) && k < 1 << volume.Axes().size(); ++k)
  {
    any = any || volume.IsObject(CellCorner(volume, cell, k));
  }
  return any;
}

/** Definition 6: dot*|dot| / ((A.A)(C.C)) of the two points as seen from the
 * center of the cell. */
inline double
CosineKey(const Volume & volume, const Index3 & cell, const Index3 & ni, const Index3 & nj)
{
  Vector3 a{};
  Vector3 c{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double center = cell[axis] + (volume.size[axis] > 1 ? 0.5 : 0.0);
    const double unit = volume.HasEqualSpacing() ? 1.0 : volume.spacing[axis];
    a[axis] = (ni[axis] - center) * unit;
    c[axis] = (nj[axis] - center) * unit;
  }
  const double ac = a[0] * c[0] + a[1] * c[1] + a[2] * c[2];
  const double aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  const double cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  return (ac * std::abs(ac)) / (aa * cc);
}

/** Definition 6. `unique` tells whether the winning key is smaller than all
 * others by more than `gap`. */
inline Pair
ChoosePair(const Volume &              volume,
           const std::vector<Index3> & sites,
           const std::vector<long> &   nearest,
           const Index3 &              cell,
           double                      gap = 1e-12)
{
  const auto dimension = static_cast<int>(volume.Axes().size());
  Pair       best;
  double     second = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 1 << (dimension - 1); ++k)
  {
    Pair pair;
    pair.vi = CellCorner(volume, cell, k);
    pair.vj = CellCorner(volume, cell, (1 << dimension) - 1 - k);
    pair.ni = nearest[volume.Offset(pair.vi)];
    pair.nj = nearest[volume.Offset(pair.vj)];
    if (pair.ni < 0 || pair.nj < 0)
    {
      continue;
    }
    pair.defined = true;
    pair.key = CosineKey(volume, cell, sites[pair.ni], sites[pair.nj]);
    if (!best.defined || pair.key < best.key)
    {
      second = best.defined ? best.key : second;
      best = pair;
    }
    else
    {
      second = std::min(second, pair.key);
    }
  }
  best.unique = second - best.key > gap;
  return best;
}

/** Eq. 2 as definition 8 reads it; a negative value where it cannot decide. */
inline double
PaperPseudoGeodesic(const Volume & volume, const Index3 & vi, const Index3 & ni, const Index3 & vj, const Index3 & nj)
{
  const double di = PhysicalDistance(volume, vi, ni);
  const double dj = PhysicalDistance(volume, vj, nj);
  if (di == 0.0 || dj == 0.0)
  {
    return -1.0;
  }
  double dot = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    dot += (ni[axis] - vi[axis]) * volume.spacing[axis] * (nj[axis] - vj[axis]) * volume.spacing[axis];
  }
  return std::min(di, dj) * std::acos(std::min(1.0, std::max(-1.0, dot / (di * dj))));
}

/** Whether a and b are the same or 3^D - 1 neighbors joined by an edge shorter
 * than epsilon. */
inline bool
IsTrivialPair(const Volume & volume, const Index3 & a, const Index3 & b, double epsilon)
{
  int mask = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(a[axis] - b[axis]) > 1)
    {
      return false;
    }
    mask |= a[axis] != b[axis] ? 1 << axis : 0;
  }
  return mask == 0 || EdgeLength(volume, mask) < epsilon;
}

/** Eq. 1. */
inline double
EpsilonOf(double thickness)
{
  return 3.14159265358979323846 * thickness / 2;
}

/** A thickness whose epsilon is exactly this double, or 0 where there is none.
 */
inline double
ThicknessForEpsilon(double epsilon)
{
  double thickness = epsilon * 2 / 3.14159265358979323846 * (1.0 - 1e-14);
  while (EpsilonOf(thickness) < epsilon)
  {
    thickness = std::nextafter(thickness, 1e300);
  }
  return EpsilonOf(thickness) == epsilon ? thickness : 0.0;
}

/** Where one spacing is more than four times another, no thickness counts as less than the largest. */
inline double
LeastThickness(const Volume & volume)
{
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const int axis : volume.Axes())
  {
    smallest = std::min(smallest, volume.spacing[axis]);
    largest = std::max(largest, volume.spacing[axis]);
  }
  return largest / smallest > 4.0 ? largest : 0.0;
}

/** All definitions together: labels and counts of a whole volume. */
class Classifier
{
public:
  Classifier(const Volume & volume, double thickness, PathSums sums = PathSums::Doubles)
    : m_Volume(volume)
    , m_Epsilon(EpsilonOf(std::max(thickness, LeastThickness(volume))))
    , m_Sums(sums)
    , m_Sites(BoundarySites(volume))
    , m_Nearest(NearestBoundaryPoints(volume, m_Sites))
    , m_Graph(volume, m_Sites)
  {}

  Classification
  Run(Bound bound)
  {
    Classification result;
    result.labels.assign(m_Volume.object.size(), 0);
    result.counts.objectVoxels =
      static_cast<std::uint64_t>(std::count(m_Volume.object.begin(), m_Volume.object.end(), 1));
    result.counts.boundaryVoxels = m_Sites.size();
    for (std::size_t i = 0; i < m_Volume.object.size(); ++i)
    {
      if (IsCandidate(m_Volume, m_Volume.IndexAt(i)))
      {
        ++result.counts.candidateCells;
        result.labels[i] = this->LabelOf(m_Volume.IndexAt(i), bound, result.counts);
      }
    }
    return result;
  }

  /** The cells whose label cannot depend on a tie: every corner has one nearest
   * point, and one pair wins. */
  std::vector<unsigned char>
  TieFreeCells() const
  {
    std::vector<unsigned char> tieFree(m_Volume.object.size(), 0);
    const auto                 corners = 1 << m_Volume.Axes().size();
    for (std::size_t i = 0; i < tieFree.size(); ++i)
    {
      const Index3 cell = m_Volume.IndexAt(i);
      if (!IsCandidate(m_Volume, cell))
      {
        continue;
      }
      bool unique = ChoosePair(m_Volume, m_Sites, m_Nearest, cell).unique;
      for (int k = 0; k < corners; ++k)
      {
        const Index3 corner = CellCorner(m_Volume, cell, k);
        unique =
          unique && (m_Nearest[m_Volume.Offset(corner)] < 0 || CountNearestSites(m_Volume, m_Sites, corner) == 1);
      }
      tieFree[i] = unique ? 1 : 0;
    }
    return tieFree;
  }

  double
  GetEpsilon() const
  {
    return m_Epsilon;
  }
  const std::vector<Index3> &
  GetSites() const
  {
    return m_Sites;
  }
  const std::vector<long> &
  GetNearest() const
  {
    return m_Nearest;
  }

  /** Correct geodesic distance between two sites; anything from epsilon + 1e-6
   * up may come back as infinite. */
  double
  GeodesicDistance(long from, long to)
  {
    auto found = m_DistancesFrom.find(from);
    if (found == m_DistancesFrom.end())
    {
      if (m_DistancesFrom.size() == 500) // bounds the memory of large volumes
      {
        m_DistancesFrom.clear();
      }
      const auto source = static_cast<int>(from);
      const auto limit = m_Epsilon * (1.0 + 1e-6);
      found = m_DistancesFrom
                .emplace(from,
                         m_Sums == PathSums::Exact ? m_Graph.ExactDistancesFrom(source, limit)
                                                   : m_Graph.DistancesFrom(source, limit))
                .first;
    }
    return found->second[to];
  }

private:
  unsigned char
  LabelOf(const Index3 & cell, Bound bound, Counts & counts)
  {
    const Pair pair = ChoosePair(m_Volume, m_Sites, m_Nearest, cell);
    if (!pair.defined || IsTrivialPair(m_Volume, m_Sites[pair.ni], m_Sites[pair.nj], m_Epsilon))
    {
      ++counts.trivialCells;
      return 1;
    }
    if (this->BoundOf(pair, bound) >= m_Epsilon)
    {
      ++counts.boundCells;
      return 2;
    }
    const double geodesic = this->GeodesicDistance(pair.ni, pair.nj);
    if (m_Sums == PathSums::Doubles && std::abs(geodesic - m_Epsilon) < 1e-9 * m_Epsilon)
    {
      throw std::logic_error("a path length within 1e-9 of epsilon, relatively, needs PathSums::Exact");
    }
    ++(geodesic >= m_Epsilon ? counts.geodesicMedialCells : counts.geodesicNonMedialCells);
    return geodesic >= m_Epsilon ? 3 : 1;
  }

  double
  BoundOf(const Pair & pair, Bound bound)
  {
    const Index3 & a = m_Sites[pair.ni];
    const Index3 & b = m_Sites[pair.nj];
    switch (bound)
    {
      case Bound::FreeSpace:
        return this->FreeSpaceLengthOf({ { std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) } });
      case Bound::Paper:
        return PaperPseudoGeodesic(m_Volume, pair.vi, a, pair.vj, b);
      default:
        return -1.0;
    }
  }

  double
  FreeSpaceLengthOf(const Index3 & offset)
  {
    const auto found = m_FreeSpaceLengths.find(offset);
    return found != m_FreeSpaceLengths.end()
             ? found->second
             : m_FreeSpaceLengths.emplace(offset, FreeSpaceLength(m_Volume, Index3{}, offset)).first->second;
  }

  const Volume &                      m_Volume;
  double                              m_Epsilon;
  PathSums                            m_Sums;
  std::vector<Index3>                 m_Sites;
  std::vector<long>                   m_Nearest;
  BoundaryGraph                       m_Graph;
  std::map<long, std::vector<double>> m_DistancesFrom;
  std::map<Index3, double>            m_FreeSpaceLengths;
};

inline Classification
Classify(const Volume & volume, double thickness, Bound bound, PathSums sums = PathSums::Doubles)
{
  return Classifier(volume, thickness, sums).Run(bound);
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestClassification_h
