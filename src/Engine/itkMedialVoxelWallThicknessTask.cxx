// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallThicknessTask.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace itk
{

struct MedialVoxelWallThicknessTask::TileWorkspace : public Workspace
{
  MedialVoxelWallPainter::Workspace painter;
  std::vector<float>                thickness;
};

MedialVoxelWallThicknessTask::MedialVoxelWallThicknessTask(const MedialVoxelGrid &           grid,
                                                           const MedialVoxelLocalThickness & settings,
                                                           const MedialVoxelWallBalls &      balls)
  : m_Maximum(static_cast<float>(settings.maximumThickness))
  , m_Painter(grid, 0.5 * settings.maximumThickness)
  , m_Balls(balls)
{}

auto
MedialVoxelWallThicknessTask::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return std::make_unique<TileWorkspace>();
}

MedialVoxelBox
MedialVoxelWallThicknessTask::Process(const MedialVoxelBox &          tile,
                                      const MedialVoxelMovingWindow & window,
                                      const MedialVoxelProgress &,
                                      Workspace &               genericWorkspace,
                                      MedialVoxelEngineClient & client,
                                      MedialVoxelSums &         sums) const
{
  auto &                workspace = static_cast<TileWorkspace &>(genericWorkspace);
  MedialVoxelTileResult result;
  result.box = tile;
  result.object = &window.GetObject();
  result.isEmpty = !window.GetObject().Any(tile);
  if (!result.isEmpty)
  {
    const auto start = std::chrono::steady_clock::now();
    m_Balls.Copy(m_Painter.GetCellBox(tile), workspace.painter.balls);
    m_Painter.Paint(tile, window.GetObject(), workspace.painter, workspace.thickness);
    sums.classificationSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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

} // end namespace itk
