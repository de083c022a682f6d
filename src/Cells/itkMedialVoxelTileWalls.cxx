// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileWalls.h"

#include "itkMedialVoxelProgress.h"

namespace itk
{

namespace
{

/** A wall takes as long as so many short steps. */
constexpr std::uint32_t StepsOfWall = 8;
constexpr std::uint32_t StepsOfGrayWall = 256;

} // namespace

void
MedialVoxelMeasureWalls(const MedialVoxelThickness &            thickness,
                        const MedialVoxelClassifier &           classifier,
                        const MedialVoxelWindow &               window,
                        const MedialVoxelFeatures &             features,
                        const std::vector<MedialVoxelCellRow> & rows,
                        std::vector<MedialVoxelWall> &          walls)
{
  std::size_t number = 0;
  for (const MedialVoxelCellRow & row : rows)
  {
    number += static_cast<std::size_t>(MedialVoxelPopulationCount(row.measured));
  }
  walls.clear();
  walls.reserve(number);
  MedialVoxelWallPoints  points;
  MedialVoxelPollCounter poll;
  for (const MedialVoxelCellRow & row : rows)
  {
    for (MedialVoxelBits::WordType rest = row.measured; rest != 0; rest &= rest - 1)
    {
      poll.Count(StepsOfWall);
      const MedialVoxelIndex cell{ { row.first[0] + MedialVoxelLowestBit(rest), row.first[1], row.first[2] } };
      classifier.GetWallPoints(features, cell, points);
      walls.push_back(thickness.Measure(*window.object, points));
    }
  }
}

MedialVoxelBox
MedialVoxelRefineWalls(const MedialVoxelGrayThickness &        thickness,
                       const MedialVoxelClassifier &           classifier,
                       const MedialVoxelGray &                 gray,
                       const MedialVoxelFeatures &             features,
                       const std::vector<MedialVoxelCellRow> & rows,
                       MedialVoxelGrayThickness::Workspace &   workspace,
                       std::vector<MedialVoxelWall> &          walls)
{
  MedialVoxelBox         missing;
  MedialVoxelWallPoints  points;
  MedialVoxelPollCounter poll;
  auto                   wall = walls.begin();
  for (const MedialVoxelCellRow & row : rows)
  {
    for (MedialVoxelBits::WordType rest = row.measured; rest != 0; rest &= rest - 1)
    {
      poll.Count(StepsOfGrayWall);
      const MedialVoxelIndex cell{ { row.first[0] + MedialVoxelLowestBit(rest), row.first[1], row.first[2] } };
      classifier.GetWallPoints(features, cell, points);
      const MedialVoxelBox needed = thickness.GetReadBox(points);
      if (gray.GetBox().Contains(needed))
      {
        thickness.Refine(gray, points, workspace, *wall);
      }
      else
      {
        missing = missing.Union(needed);
      }
      ++wall;
    }
  }
  return missing;
}

} // end namespace itk
