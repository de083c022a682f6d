// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelCellLevels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{

MedialVoxelCellLevels::MedialVoxelCellLevels(const MedialVoxelGrid & grid)
  : m_Grid(grid)
  , m_Unit(grid.GetUnitMargin())
  , m_SmallestSpacing(grid.GetShortestEdge() / grid.GetMetricUnit())
{}

void
MedialVoxelCellLevels::Compute(const MedialVoxelBox &      tile,
                               const MedialVoxelBits &     object,
                               const MedialVoxelFeatures & features,
                               std::vector<LevelType> &    levels) const
{
  levels.assign(static_cast<std::size_t>(tile.NumberOfVoxels()), 0);
  const MedialVoxelBox cells = tile.Intersection(m_Grid.GetCellBox());
  for (std::int64_t z = cells.lower[2]; z < cells.upper[2]; ++z)
  {
    for (std::int64_t y = cells.lower[1]; y < cells.upper[1]; ++y)
    {
      for (std::int64_t x = cells.lower[0]; x < cells.upper[0]; x += MedialVoxelBits::BitsPerWord)
      {
        // Cells whose corners are all object.
        auto inside = ~MedialVoxelBits::WordType{ 0 };
        for (std::int64_t corner = z; corner <= z + m_Unit[2]; ++corner)
        {
          for (std::int64_t row = y; row <= y + m_Unit[1]; ++row)
          {
            inside &= object.Extract(x, row, corner) & object.Extract(x + m_Unit[0], row, corner);
          }
        }
        for (; inside != 0; inside &= inside - 1)
        {
          const MedialVoxelIndex cell{ { x + MedialVoxelLowestBit(inside), y, z } };
          if (cell[0] < cells.upper[0])
          {
            levels[tile.OffsetOf(cell)] = this->FindLevel(cell, features);
          }
        }
      }
    }
  }
}

auto
MedialVoxelCellLevels::FindLevel(const MedialVoxelIndex & cell, const MedialVoxelFeatures & features) const -> LevelType
{
  double smallest = std::numeric_limits<double>::infinity();
  for (std::int64_t z = cell[2]; z <= cell[2] + m_Unit[2]; ++z)
  {
    for (std::int64_t y = cell[1]; y <= cell[1] + m_Unit[1]; ++y)
    {
      for (std::int64_t x = cell[0]; x <= cell[0] + m_Unit[0]; ++x)
      {
        const std::size_t offset = features.OffsetOf(x, y, z);
        if (!features.HasSite(offset))
        {
          return MedialVoxelThinning::NoLevel;
        }
        smallest =
          std::min(smallest, m_Grid.SquaredMetricLength(features.dx[offset], features.dy[offset], features.dz[offset]));
      }
    }
  }
  const double level = std::floor(std::sqrt(smallest) / m_SmallestSpacing);
  return static_cast<LevelType>(std::min<double>(level, MedialVoxelThinning::NoLevel - 1));
}

} // end namespace itk
