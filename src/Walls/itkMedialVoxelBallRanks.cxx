// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBallRanks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace itk
{

MedialVoxelBallRanks::MedialVoxelBallRanks(const MedialVoxelGrid & grid, const double maximumRadius)
  : m_Grid(grid)
  , m_MaximumRadius(maximumRadius)
  , m_Margin(grid.MarginForMetricLength(maximumRadius / grid.GetMetricUnit()))
{
  assert(maximumRadius > 0.0 && std::isfinite(maximumRadius));
  std::size_t displacements = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    // No displacement leads out of the image.
    m_Margin[axis] = std::min(m_Margin[axis], grid.GetSize()[axis] - 1);
    displacements *= static_cast<std::size_t>(m_Margin[axis] + 1);
  }
  m_RankOfDisplacement.resize(displacements);
  this->RankDisplacements();
}

/** From the shortest to the longest displacement; all from the maximum on have the last rank. */
void
MedialVoxelBallRanks::RankDisplacements()
{
  struct Displacement
  {
    double           square;
    MedialVoxelIndex at;
  };
  std::vector<Displacement> displacements;
  displacements.reserve(m_RankOfDisplacement.size());
  for (std::int64_t z = 0; z <= m_Margin[2]; ++z)
  {
    for (std::int64_t y = 0; y <= m_Margin[1]; ++y)
    {
      for (std::int64_t x = 0; x <= m_Margin[0]; ++x)
      {
        displacements.push_back({ m_Grid.SquaredMetricLength(x, y, z), { { x, y, z } } });
      }
    }
  }
  std::sort(displacements.begin(), displacements.end(), [](const Displacement & a, const Displacement & b) {
    return a.square < b.square;
  });

  const double          radius = m_MaximumRadius / m_Grid.GetMetricUnit();
  const double          largest = radius * radius;
  std::array<double, 8> needed{}; // by the voxels of the balls so far
  this->AddRank(0.0, needed);     // background, whose displacement is 0
  std::array<double, 8> next = needed;
  for (const Displacement & displacement : displacements)
  {
    const double square = std::min(displacement.square, largest);
    if (square > m_Squares.back())
    {
      needed = next;
      this->AddRank(square, needed);
    }
    const MedialVoxelIndex & at = displacement.at;
    m_RankOfDisplacement[this->GetPlace(at[0], at[1], at[2])] = this->GetLast();
    for (unsigned int step = 0; step < next.size() && displacement.square < largest; ++step)
    {
      const double fromNeighbor =
        m_Grid.SquaredMetricLength(at[0] + (step & 1 ? 1 : 0), at[1] + (step & 2 ? 1 : 0), at[2] + (step & 4 ? 1 : 0));
      next[step] = std::max(next[step], fromNeighbor);
    }
  }
  if (m_Squares.back() < largest)
  {
    this->AddRank(largest, next);
  }
}

/** A ball with this square of the radius, and for each step to a neighbor the square that contains all of its
 * voxels. */
void
MedialVoxelBallRanks::AddRank(const double square, const std::array<double, 8> & needed)
{
  m_Squares.push_back(square);
  for (std::size_t step = 0; step < needed.size(); ++step)
  {
    m_Needed[step].push_back(needed[step]);
  }
}

float
MedialVoxelBallRanks::GetRadius(const std::uint32_t rank) const
{
  return static_cast<float>(rank == this->GetLast() ? m_MaximumRadius
                                                    : std::sqrt(m_Squares[rank]) * m_Grid.GetMetricUnit());
}

std::uint32_t
MedialVoxelBallRanks::GetRank(const MedialVoxelFeatures & features, const std::size_t offset) const
{
  if (!features.HasSite(offset))
  {
    return this->GetLast();
  }
  const std::int64_t x = std::abs(features.dx[offset]);
  const std::int64_t y = std::abs(features.dy[offset]);
  const std::int64_t z = std::abs(features.dz[offset]);
  if (x > m_Margin[0] || y > m_Margin[1] || z > m_Margin[2])
  {
    return this->GetLast();
  }
  return m_RankOfDisplacement[this->GetPlace(x, y, z)];
}

} // end namespace itk
