// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileWalls.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>

namespace itk
{

namespace
{

/** A wall takes as long as so many short steps. */
constexpr std::uint32_t StepsOfWall = 8;
constexpr std::uint32_t StepsOfGrayWall = 256;

/** A row of cells that are measured, and the number of its first wall. */
struct MeasuredRow
{
  const MedialVoxelCellRow * row;
  std::size_t                firstWall;
};
using MeasuredRows = std::vector<MeasuredRow>;

/** The rows that have measured cells, in their order. */
MeasuredRows
FindMeasuredRows(const std::vector<MedialVoxelCellRow> & rows)
{
  MeasuredRows measured;
  std::size_t  number = 0;
  for (const MedialVoxelCellRow & row : rows)
  {
    if (row.measured != 0)
    {
      measured.push_back({ &row, number });
      number += static_cast<std::size_t>(MedialVoxelPopulationCount(row.measured));
    }
  }
  return measured;
}

/** The square of 2^BitsOfBundle rows that a row is in. */
constexpr int BitsOfBundle = 3;

std::array<std::int64_t, 3>
BundleOf(const MeasuredRow & measured)
{
  const MedialVoxelIndex & first = measured.row->first;
  return { { first[2] >> BitsOfBundle, first[1] >> BitsOfBundle, first[0] } };
}

/** Calls function(points, wall) for the walls at the measured cells of rows, with the number of the wall. */
template <typename TFunction>
void
ForEachWallPoints(const MedialVoxelClassifier & classifier,
                  const MedialVoxelFeatures &   features,
                  const MeasuredRows &          rows,
                  const std::uint32_t           steps,
                  TFunction &&                  function)
{
  MedialVoxelWallPoints   points;
  MedialVoxelAbortChecker checker;
  const auto              findCells = [&](const auto measured) {
    return measured == rows.end() ? MedialVoxelCells()
                                               : classifier.FindCells(features, measured->row->first, measured->row->measured);
  };
  // The displacements of one row come from memory while the walls of the row before are measured.
  MedialVoxelCells nextCells = findCells(rows.begin());
  for (auto measured = rows.begin(); measured != rows.end(); ++measured)
  {
    const MedialVoxelCellRow & row = *measured->row;
    const MedialVoxelCells     cells = nextCells;
    nextCells = findCells(measured + 1);
    std::size_t wall = measured->firstWall;
    for (MedialVoxelBits::WordType rest = row.measured; rest != 0; rest &= rest - 1)
    {
      const int x = MedialVoxelLowestBit(rest);
      checker.Count(steps);
      classifier.GetWallPoints(features, cells, x, row.diagonals.Get(x), points);
      function(points, wall++);
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
  walls.clear();
  memory.Clear();
  const MeasuredRows measured = FindMeasuredRows(rows);
  if (!measured.empty())
  {
    const MeasuredRow & last = measured.back();
    walls.reserve(last.firstWall + static_cast<std::size_t>(MedialVoxelPopulationCount(last.row->measured)));
  }
  ForEachWallPoints(
    classifier, features, measured, StepsOfWall, [&](const MedialVoxelWallPoints & points, std::size_t) {
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
  MeasuredRows   measured = FindMeasuredRows(rows);
  // Walls near each other share the gradients that the workspace keeps.
  std::stable_sort(measured.begin(), measured.end(), [](const MeasuredRow & a, const MeasuredRow & b) {
    return BundleOf(a) < BundleOf(b);
  });
  const auto refine = [&](const MedialVoxelWallPoints & points, const std::size_t wall) {
    const MedialVoxelBox needed = thickness.GetReadBox(points);
    if (gray.GetBox().Contains(needed))
    {
      thickness.Refine(gray, points, workspace, walls[wall]);
    }
    else
    {
      missing = missing.Union(needed);
    }
  };
  ForEachWallPoints(classifier, features, measured, StepsOfGrayWall, refine);
  return missing;
}

} // end namespace itk
