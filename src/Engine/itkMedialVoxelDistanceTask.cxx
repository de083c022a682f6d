// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelDistanceTask.h"

#include <chrono>

namespace itk
{

struct MedialVoxelDistanceTask::TileWorkspace : public Workspace
{
  MedialVoxelFeatureTransform::Workspace transform;
  MedialVoxelFeatures                    features;
};

MedialVoxelDistanceTask::MedialVoxelDistanceTask(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings)
  : m_Boundary(settings.boundary)
  , m_Transform(grid, settings.region, settings.maximumDistance)
{}

auto
MedialVoxelDistanceTask::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return std::make_unique<TileWorkspace>();
}

MedialVoxelBox
MedialVoxelDistanceTask::Process(const MedialVoxelBox &          tile,
                                 const MedialVoxelMovingWindow & window,
                                 const MedialVoxelProgress &     progress,
                                 Workspace &                     genericWorkspace,
                                 MedialVoxelEngineClient &       client,
                                 MedialVoxelSums &               sums) const
{
  auto &               workspace = static_cast<TileWorkspace &>(genericWorkspace);
  const auto           start = std::chrono::steady_clock::now();
  const MedialVoxelBox missing =
    m_Transform.Compute(window.GetWindow(m_Boundary), tile, workspace.transform, workspace.features, &progress);
  sums.distanceSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (missing.IsEmpty() && !progress.IsAborted())
  {
    sums.counts.objectVoxels = window.GetObject().Count(tile);
    MedialVoxelTileResult result;
    result.box = tile;
    result.displacements = &workspace.features;
    result.object = &window.GetObject();
    client.TakeTile(result);
  }
  return missing;
}

} // end namespace itk
