// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileSchedule.h"

#include <algorithm>
#include <utility>

namespace itk
{

std::vector<MedialVoxelBox>
MedialVoxelCutIntoTiles(const MedialVoxelBox & region, const MedialVoxelIndex & tileSize)
{
  const auto nextCut = [&](const unsigned int axis, const std::int64_t position) {
    const std::int64_t cut = (position / tileSize[axis] + 1) * tileSize[axis];
    return std::min(cut, region.upper[axis]);
  };
  std::vector<MedialVoxelBox> tiles;
  if (region.IsEmpty())
  {
    return tiles;
  }
  MedialVoxelBox tile;
  for (tile.lower[2] = region.lower[2]; tile.lower[2] < region.upper[2]; tile.lower[2] = tile.upper[2])
  {
    tile.upper[2] = nextCut(2, tile.lower[2]);
    for (tile.lower[1] = region.lower[1]; tile.lower[1] < region.upper[1]; tile.lower[1] = tile.upper[1])
    {
      tile.upper[1] = nextCut(1, tile.lower[1]);
      for (tile.lower[0] = region.lower[0]; tile.lower[0] < region.upper[0]; tile.lower[0] = tile.upper[0])
      {
        tile.upper[0] = nextCut(0, tile.lower[0]);
        tiles.push_back(tile);
      }
    }
  }
  return tiles;
}

MedialVoxelTileSchedule::MedialVoxelTileSchedule(std::vector<MedialVoxelBox> tiles)
  : m_Tiles(std::move(tiles))
{}

bool
MedialVoxelTileSchedule::Next(MedialVoxelBox & tile)
{
  if (m_IsStopped)
  {
    return false;
  }
  const std::size_t number = m_Next++;
  if (number >= m_Tiles.size())
  {
    return false;
  }
  tile = m_Tiles[number];
  return true;
}

void
MedialVoxelTileSchedule::Defer(const MedialVoxelBox & tile, const MedialVoxelBox & needed)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_DeferredTiles.push_back(tile);
  m_NeededBox = m_NeededBox.Union(needed);
}

void
MedialVoxelTileSchedule::Stop()
{
  m_IsStopped = true;
}

void
MedialVoxelTileSchedule::Fail(std::exception_ptr failure)
{
  this->Stop();
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (!m_Failure)
  {
    m_Failure = std::move(failure);
  }
}

void
MedialVoxelTileSchedule::RethrowFailure() const
{
  if (m_Failure)
  {
    std::rethrow_exception(m_Failure);
  }
}

} // end namespace itk
