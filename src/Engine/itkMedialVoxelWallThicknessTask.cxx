// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallThicknessTask.h"

#include "itkMedialVoxelTileWalls.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace itk
{

struct MedialVoxelWallThicknessTask::TileWorkspace : public Workspace
{
  std::unique_ptr<Workspace>        extraction;
  MedialVoxelWallPainter::Workspace painter;
  std::vector<float>                thickness;
};

MedialVoxelSheetExtraction
MedialVoxelWallThicknessTask::GetExtraction(const MedialVoxelLocalThickness & settings)
{
  MedialVoxelSheetExtraction extraction;
  extraction.parameters = settings.walls->parameters;
  extraction.grayRange = settings.walls->grayRange;
  extraction.measuresThickness = true;
  extraction.vectorBoundary = MedialVoxelBoundary::Background; // for the radii
  return extraction;
}

MedialVoxelWallThicknessTask::MedialVoxelWallThicknessTask(const MedialVoxelGrid &           grid,
                                                           const MedialVoxelLocalThickness & settings)
  : m_MaximumRadius(0.5 * settings.maximumThickness / grid.GetMetricUnit())
  , m_Maximum(static_cast<float>(settings.maximumThickness))
  , m_Painter(grid, 0.5 * settings.maximumThickness)
  , m_Extraction(grid, GetExtraction(settings))
  , m_Pairs(grid, settings.walls->parameters.epsilon)
  , m_Threshold(grid, settings.walls->parameters)
{}

auto
MedialVoxelWallThicknessTask::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  auto workspace = std::make_unique<TileWorkspace>();
  workspace->extraction = m_Extraction.MakeWorkspace();
  return workspace;
}

MedialVoxelBox
MedialVoxelWallThicknessTask::Process(const MedialVoxelBox &          tile,
                                      const MedialVoxelMovingWindow & window,
                                      const MedialVoxelProgress &     progress,
                                      Workspace &                     genericWorkspace,
                                      MedialVoxelEngineClient &       client,
                                      MedialVoxelSums &               sums) const
{
  auto &                workspace = static_cast<TileWorkspace &>(genericWorkspace);
  MedialVoxelTileResult result;
  result.box = tile;
  result.object = &window.GetObject();
  result.isEmpty = !window.GetObject().Any(tile);
  if (!result.isEmpty)
  {
    const MedialVoxelBox missing = this->FindWalls(tile, window, progress, workspace, sums);
    if (!missing.IsEmpty() || progress.IsAborted())
    {
      return missing;
    }
    const auto start = std::chrono::steady_clock::now();
    m_Painter.Paint(tile, window.GetObject(), workspace.painter, workspace.thickness);
    sums.classificationSeconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.localThickness = &workspace.thickness;
    const auto count = [&](const auto & isCounted) {
      return static_cast<std::uint64_t>(
        std::count_if(workspace.thickness.begin(), workspace.thickness.end(), isCounted));
    };
    sums.localThickness.Add(workspace.thickness, m_Maximum);
    sums.voxelsAtMaximum = count([this](const float thickness) { return thickness == m_Maximum; });
    sums.voxelsWithoutWall = count([](const float thickness) { return std::isnan(thickness); });
  }
  sums.counts.objectVoxels = window.GetObject().Count(tile);
  client.TakeTile(result);
  return {};
}

/** Lists the balls of all walls around a tile.
 * \return an empty box when done, otherwise the sites that must be known */
MedialVoxelBox
MedialVoxelWallThicknessTask::FindWalls(const MedialVoxelBox &          tile,
                                        const MedialVoxelMovingWindow & window,
                                        const MedialVoxelProgress &     progress,
                                        TileWorkspace &                 workspace,
                                        MedialVoxelSums &               sums) const
{
  const MedialVoxelBox cellBox = m_Painter.GetCellBox(tile);
  workspace.painter.balls.clear();
  // A window with little memory may be smaller.
  if (!window.GetWindow(MedialVoxelBoundary::Background).sites->GetBox().Contains(cellBox))
  {
    return cellBox;
  }
  MedialVoxelSums       sumsOfCells; // of the neighboring tiles too
  MedialVoxelTileResult cells;
  const MedialVoxelBox  missing =
    m_Extraction.Extract(cellBox, window, progress, *workspace.extraction, cells, sumsOfCells);
  sums.distanceSeconds = sumsOfCells.distanceSeconds;
  sums.classificationSeconds = sumsOfCells.classificationSeconds;
  if (!cells.box.IsEmpty() && !cells.isEmpty)
  {
    this->ListBalls(cells, workspace.painter.balls);
  }
  return missing;
}

void
MedialVoxelWallThicknessTask::ListBalls(const MedialVoxelTileResult &               cells,
                                        std::vector<MedialVoxelWallPainter::Ball> & balls) const
{
  const MedialVoxelFeatures & features = *cells.displacements;
  MedialVoxelForEachWall(*cells.rows, *cells.walls, [&](const MedialVoxelIndex & cell, const MedialVoxelWall & wall) {
    MedialVoxelDiagonal widest;
    if (wall.IsMeasured() && m_Pairs.Choose(features, m_Pairs.CellAt(features, cell), 0, widest))
    {
      balls.push_back(
        { cell, std::min(m_Threshold.RadiusOf(widest), m_MaximumRadius), std::min(wall.thickness, m_Maximum) });
    }
  });
}

} // end namespace itk
