// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelDualCell.h"

#include "itkMedialVoxelElementary.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace itk
{

MedialVoxelDualCell::MedialVoxelDualCell(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (grid.IsActive(axis))
    {
      for (unsigned int corner = 0; corner < m_NumberOfCorners; ++corner)
      {
        m_Corners[m_NumberOfCorners + corner] = m_Corners[corner];
        m_Corners[m_NumberOfCorners + corner][axis] = 1;
      }
      m_NumberOfCorners *= 2;
    }
  }
}

double
MedialVoxelDualCell::CosineKey(const unsigned int              diagonal,
                               const MedialVoxelDisplacement & displacement,
                               const MedialVoxelDisplacement & oppositeDisplacement) const
{
  const MedialVoxelDisplacement & corner = m_Corners[diagonal];
  const MedialVoxelDisplacement & opposite = m_Corners[this->GetOppositeCorner(diagonal)];
  double                          dot = 0.0;
  double                          squaredA = 0.0;
  double                          squaredC = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double spacing = m_Grid.GetMetricSpacing()[axis];
    const double center = m_Grid.IsActive(axis) ? 0.5 : 0.0;
    const double a = (static_cast<double>(corner[axis] + displacement[axis]) - center) * spacing;
    const double c = (static_cast<double>(opposite[axis] + oppositeDisplacement[axis]) - center) * spacing;
    dot += a * c;
    squaredA += a * a;
    squaredC += c * c;
  }
  return (dot * std::abs(dot)) / (squaredA * squaredC);
}

bool
MedialVoxelDualCell::IsTrivial(const MedialVoxelDisplacement & difference, const double epsilon) const
{
  unsigned int mask = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(difference[axis]) > 1)
    {
      return false;
    }
    mask |= (difference[axis] != 0) ? 1u << axis : 0u;
  }
  return m_Grid.GetEdgeLength(mask) < epsilon;
}

double
MedialVoxelDualCell::FreeSpaceLength(const MedialVoxelDisplacement & difference) const
{
  // The length of an edge is a concave function of a sum over its axes, hence submodular: steps along all axes first,
  // then along the two longest, then along the longest, are the shortest path.
  std::array<unsigned int, 3> order{ { 0, 1, 2 } };
  const auto                  steps = [&](const unsigned int i) { return std::abs(difference[order[i]]); };
  const auto                  sort = [&](const unsigned int i, const unsigned int j) {
    if (steps(i) < steps(j))
    {
      std::swap(order[i], order[j]);
    }
  };
  sort(0, 1);
  sort(1, 2);
  sort(0, 1);
  const unsigned int longest = 1u << order[0];
  const unsigned int longer = longest | 1u << order[1];
  // In the order of MedialVoxelPathLength().
  return (static_cast<double>(steps(0) - steps(1)) * m_Grid.GetEdgeLength(longest) +
          static_cast<double>(steps(1) - steps(2)) * m_Grid.GetEdgeLength(longer)) +
         static_cast<double>(steps(2)) * m_Grid.GetEdgeLength(7);
}

double
MedialVoxelDualCell::PseudoGeodesicDistance(const MedialVoxelDisplacement & a, const MedialVoxelDisplacement & b) const
{
  double dot = 0.0;
  double squaredA = 0.0;
  double squaredB = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double spacing = m_Grid.GetSpacing()[axis];
    const double componentA = static_cast<double>(a[axis]) * spacing;
    const double componentB = static_cast<double>(b[axis]) * spacing;
    dot += componentA * componentB;
    squaredA += componentA * componentA;
    squaredB += componentB * componentB;
  }
  if (squaredA == 0.0 || squaredB == 0.0)
  {
    return 0.0;
  }
  const double theta = MedialVoxelElementary::ArcCosine(dot / std::sqrt(squaredA * squaredB));
  return std::sqrt(std::min(squaredA, squaredB)) * theta;
}

double
MedialVoxelPathLength(const MedialVoxelGrid & grid, const MedialVoxelEdgeCounts & counts)
{
  double length = 0.0;
  for (unsigned int mask = 1; mask < 8; ++mask)
  {
    length += static_cast<double>(counts[mask]) * grid.GetEdgeLength(mask);
  }
  return length;
}

} // end namespace itk
