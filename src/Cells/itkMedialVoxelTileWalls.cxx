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

/** Calls function(points) for the walls at the measured cells of rows. */
template <typename TFunction>
void
ForEachWallPoints(const MedialVoxelClassifier &           classifier,
                  const MedialVoxelFeatures &             features,
                  const std::vector<MedialVoxelCellRow> & rows,
                  const std::uint32_t                     steps,
                  TFunction &&                            function)
{
  MedialVoxelWallPoints  points;
  MedialVoxelPollCounter poll;
  for (const MedialVoxelCellRow & row : rows)
  {
    if (row.measured == 0)
    {
      continue;
    }
    const MedialVoxelCells cells = classifier.FindCells(features, row.first, row.measured);
    for (MedialVoxelBits::WordType rest = row.measured; rest != 0; rest &= rest - 1)
    {
      poll.Count(steps);
      classifier.GetWallPoints(features, cells, MedialVoxelLowestBit(rest), points);
      function(points);
    }
  }
}

} // namespace

void
MedialVoxelMeasureWalls(const MedialVoxelThickness &            thickness,
                        const MedialVoxelClassifier &           classifier,
                        const MedialVoxelWindow &               window,
                        const MedialVoxelFeatures &             features,
                        const std::vector<MedialVoxelCellRow> & rows,
                        MedialVoxelThickness::Memory &          memory,
                        std::vector<MedialVoxelWall> &          walls)
{
  std::size_t number = 0;
  for (const MedialVoxelCellRow & row : rows)
  {
    number += static_cast<std::size_t>(MedialVoxelPopulationCount(row.measured));
  }
  walls.clear();
  walls.reserve(number);
  memory.Clear();
  ForEachWallPoints(classifier, features, rows, StepsOfWall, [&](const MedialVoxelWallPoints & points) {
    walls.push_back(thickness.Measure(*window.object, points, memory));
  });
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
  MedialVoxelBox missing;
  auto           wall = walls.begin();
  ForEachWallPoints(classifier, features, rows, StepsOfGrayWall, [&](const MedialVoxelWallPoints & points) {
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
  });
  return missing;
}

} // end namespace itk
