// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLengthTask.h"

#include <chrono>
#include <cmath>

namespace itk
{

struct MedialVoxelLengthTask::TileWorkspace : public Workspace
{
  MedialVoxelDistanceTransform::Workspace transform;
  MedialVoxelSquaredLengths               lengths;
};

bool
MedialVoxelLengthTask::CanDo(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings)
{
  return !settings.findsDisplacements && settings.region == MedialVoxelRegion::Both &&
         !std::isfinite(settings.maximumDistance) && MedialVoxelDistanceTransform::CanTransform(grid);
}

MedialVoxelLengthTask::MedialVoxelLengthTask(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings)
  : m_Boundary(settings.boundary)
  , m_Transform(grid)
{}

auto
MedialVoxelLengthTask::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return std::make_unique<TileWorkspace>();
}

MedialVoxelBox
MedialVoxelLengthTask::Process(const MedialVoxelBox &          tile,
                               const MedialVoxelMovingWindow & window,
                               const MedialVoxelProgress &,
                               Workspace &               genericWorkspace,
                               MedialVoxelEngineClient & client,
                               MedialVoxelSums &         sums) const
{
  auto &               workspace = static_cast<TileWorkspace &>(genericWorkspace);
  const auto           start = std::chrono::steady_clock::now();
  const MedialVoxelBox missing =
    m_Transform.Compute(*window.GetWindow(m_Boundary).sites, tile, workspace.transform, workspace.lengths);
  sums.distanceSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (missing.IsEmpty())
  {
    sums.counts.objectVoxels = window.GetObject().Count(tile);
    MedialVoxelTileResult result;
    result.box = tile;
    result.squaredLengths = &workspace.lengths;
    result.object = &window.GetObject();
    client.TakeTile(result);
  }
  return missing;
}

} // end namespace itk
