// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileWalls.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>

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
  MedialVoxelWallPoints   points;
  MedialVoxelAbortChecker checker;
  const auto              findMeasured = [&rows](const auto from) {
    return std::find_if(from, rows.end(), [](const MedialVoxelCellRow & row) { return row.measured != 0; });
  };
  const auto findCells = [&](const auto row) {
    return row == rows.end() ? MedialVoxelCells() : classifier.FindCells(features, row->first, row->measured);
  };
  // The displacements of one row come from memory while the walls of the row before are measured.
  auto             next = findMeasured(rows.begin());
  MedialVoxelCells nextCells = findCells(next);
  while (next != rows.end())
  {
    const auto             row = next;
    const MedialVoxelCells cells = nextCells;
    next = findMeasured(row + 1);
    nextCells = findCells(next);
    for (MedialVoxelBits::WordType rest = row->measured; rest != 0; rest &= rest - 1)
    {
      const int x = MedialVoxelLowestBit(rest);
      checker.Count(steps);
      classifier.GetWallPoints(features, cells, x, row->diagonals.Get(x), points);
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
