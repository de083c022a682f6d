// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLocalThicknessTask.h"

#include <algorithm>
#include <chrono>

namespace itk
{

struct MedialVoxelLocalThicknessTask::TileWorkspace : public Workspace
{
  MedialVoxelFeatureTransform::Workspace transform;
  MedialVoxelFeatures                    features;
  MedialVoxelBallPainter::Workspace      painter;
  std::vector<float>                     diameters;
};

MedialVoxelLocalThicknessTask::MedialVoxelLocalThicknessTask(const MedialVoxelGrid &           grid,
                                                             const MedialVoxelLocalThickness & settings)
  : m_Maximum(2.0f * static_cast<float>(0.5 * settings.maximumThickness))
  , m_Painter(grid, 0.5 * settings.maximumThickness)
  , m_Transform(grid, MedialVoxelRegion::Inside, 0.5 * settings.maximumThickness)
{}

auto
MedialVoxelLocalThicknessTask::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return std::make_unique<TileWorkspace>();
}

MedialVoxelBox
MedialVoxelLocalThicknessTask::Process(const MedialVoxelBox &          tile,
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
    const auto           start = std::chrono::steady_clock::now();
    const MedialVoxelBox missing = m_Transform.Compute(window.GetWindow(MedialVoxelBoundary::Background),
                                                       m_Painter.GetCenterBox(tile),
                                                       workspace.transform,
                                                       workspace.features,
                                                       &progress);
    const auto           middle = std::chrono::steady_clock::now();
    sums.distanceSeconds = std::chrono::duration<double>(middle - start).count();
    if (!missing.IsEmpty() || progress.IsAborted())
    {
      return missing;
    }
    m_Painter.Paint(tile, window.GetObject(), workspace.features, workspace.painter, workspace.diameters);
    sums.classificationSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - middle).count();
    result.localThickness = &workspace.diameters;
    sums.localThickness.Add(workspace.diameters, m_Maximum);
    sums.voxelsAtMaximum =
      static_cast<std::uint64_t>(std::count(workspace.diameters.begin(), workspace.diameters.end(), m_Maximum));
  }
  sums.counts.objectVoxels = window.GetObject().Count(tile);
  client.TakeTile(result);
  return {};
}

} // end namespace itk
