// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLengthTask.h"

#include "itkMedialVoxelLengthRow.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace itk
{

struct MedialVoxelLengthTask::TileWorkspace : public Workspace
{
  MedialVoxelDistanceTransform::Workspace transform;
  MedialVoxelSquaredLengths               lengths;
  MedialVoxelFeatureTransform::Workspace  search;
  MedialVoxelFeatures                     features;
  std::vector<std::int32_t>               doubtful;     ///< in ascending order
  std::int32_t                            certain{ 0 }; ///< end of the squares that were looked at

  /** The doubtful squares up to the largest one of a tile. */
  const std::vector<std::int32_t> &
  FindDoubtful(const double spacing)
  {
    const std::int32_t end = transform.GetLargest() + 1;
    if (end > certain && end <= MedialVoxelSquaredLengths::None && !MedialVoxelLengthRow::HasExactLengths(spacing))
    {
      MedialVoxelLengthRow::AppendDoubtful(spacing, certain, end, doubtful);
      certain = end;
    }
    return doubtful;
  }
};

bool
MedialVoxelLengthTask::CanDo(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings)
{
  return !settings.findsDisplacements && settings.region == MedialVoxelRegion::Both &&
         !std::isfinite(settings.maximumDistance) && MedialVoxelDistanceTransform::CanTransform(grid);
}

std::uint64_t
MedialVoxelLengthTask::GetBytes(const MedialVoxelGrid & grid, const MedialVoxelIndex & searchedSize)
{
  return MedialVoxelLengthRow::HasExactLengths(grid.GetMetricUnit())
           ? 0
           : MedialVoxelFeatureTransform::GetBytes(grid, { { 1, 1, 1 } }, searchedSize);
}

MedialVoxelLengthTask::MedialVoxelLengthTask(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings)
  : m_Boundary(settings.boundary)
  , m_Spacing(grid.GetMetricUnit())
  , m_Features(grid, settings.region)
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
  if (!missing.IsEmpty())
  {
    return missing;
  }
  sums.counts.objectVoxels = window.GetObject().Count(tile);
  MedialVoxelTileResult result;
  result.box = tile;
  result.squaredLengths = &workspace.lengths;
  result.object = &window.GetObject();
  client.TakeTile(result);
  if (!workspace.FindDoubtful(m_Spacing).empty())
  {
    this->TakeDoubtful(tile, window, workspace, client);
  }
  return {};
}

/** Write voxels of doubtful length again, by their boundary voxels. */
void
MedialVoxelLengthTask::TakeDoubtful(const MedialVoxelBox &          tile,
                                    const MedialVoxelMovingWindow & window,
                                    TileWorkspace &                 workspace,
                                    MedialVoxelEngineClient &       client) const
{
  const MedialVoxelSquaredLengths & lengths = workspace.lengths;
  const auto &                      doubtful = workspace.doubtful;
  MedialVoxelTileResult             result;
  result.displacements = &workspace.features;
  result.object = &window.GetObject();
  MedialVoxelForEachRow(tile, {}, [&](std::int64_t, const MedialVoxelBox & row) {
    const std::int32_t * const squares = lengths.values.data() + lengths.box.OffsetOf(row.lower);
    for (std::int64_t i = 0; i < row.Extent(0); ++i)
    {
      if (std::binary_search(doubtful.begin(), doubtful.end(), squares[i]))
      {
        result.box = row;
        result.box.lower[0] += i;
        result.box.upper[0] = result.box.lower[0] + 1;
        // A window that makes the length final makes the displacement final too.
        m_Features.Compute(window.GetWindow(m_Boundary), result.box, workspace.search, workspace.features);
        client.TakeTile(result);
      }
    }
  });
}

} // end namespace itk
