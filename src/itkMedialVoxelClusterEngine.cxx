// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClusterEngine.h"

#include <algorithm>
#include <utility>

namespace itk
{

namespace
{

/** Tiles of a slab below which threads would wait for each other. */
constexpr std::int64_t EnoughTiles = 64;

std::int64_t
CeilingDivide(const std::int64_t value, const std::int64_t divisor)
{
  return (value + divisor - 1) / divisor;
}

} // namespace

unsigned int
MedialVoxelSlowestAxis(const MedialVoxelBox & box)
{
  return box.Extent(2) > 1 ? 2u : (box.Extent(1) > 1 ? 1u : 0u);
}

MedialVoxelClusterEngine::MedialVoxelClusterEngine(const MedialVoxelGrid & grid, Settings settings)
  : m_Grid(grid)
  , m_Settings(std::move(settings))
  , m_TileSize(this->ChooseTileSize())
  , m_Halo(m_Settings.halo)
  , m_Window(grid, m_Settings.boundaries)
{}

MedialVoxelIndex
MedialVoxelClusterEngine::ChooseTileSize() const
{
  if (m_Settings.tileSize > 0)
  {
    return { { m_Settings.tileSize, m_Settings.tileSize, m_Settings.tileSize } };
  }
  // Whole words along x; a cube of features that fits the second-level cache.
  return m_Grid.IsActive(2) ? MedialVoxelIndex{ { 128, 32, 32 } } : MedialVoxelIndex{ { 256, 256, 1 } };
}

std::vector<MedialVoxelBox>
MedialVoxelClusterEngine::CutIntoSlabs(const MedialVoxelBox & region) const
{
  const unsigned int axis = MedialVoxelSlowestAxis(region);
  std::int64_t       thickness = m_Settings.slabThickness;
  if (thickness <= 0)
  {
    std::int64_t tilesPerLayer = 1;
    for (unsigned int other = 0; other < axis; ++other)
    {
      tilesPerLayer *= CeilingDivide(region.Extent(other), m_TileSize[other]);
    }
    thickness = m_TileSize[axis] * CeilingDivide(EnoughTiles, tilesPerLayer);
  }
  MedialVoxelIndex slabSize = m_Grid.GetSize();
  slabSize[axis] = std::min(thickness, slabSize[axis]);
  return MedialVoxelCutIntoTiles(region, slabSize);
}

MedialVoxelBox
MedialVoxelClusterEngine::GetSitesBox(const MedialVoxelBox & slab) const
{
  MedialVoxelBox voxels = slab;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    voxels.upper[axis] += m_Settings.upperMargin[axis];
  }
  return voxels.Expanded(m_Halo).Intersection(m_Grid.GetVoxelBox());
}

MedialVoxelBox
MedialVoxelClusterEngine::GetFirstObjectBox(const MedialVoxelBox & region) const
{
  const auto slabs = this->CutIntoSlabs(region);
  return slabs.empty() ? MedialVoxelBox{} : m_Window.GetObjectBox(this->GetSitesBox(slabs.front()));
}

void
MedialVoxelClusterEngine::Run(const MedialVoxelBox & region, MedialVoxelClusterClient & client)
{
  for (const MedialVoxelBox & slab : this->CutIntoSlabs(region))
  {
    MedialVoxelBox              sites = this->GetSitesBox(slab);
    std::vector<MedialVoxelBox> tiles = MedialVoxelCutIntoTiles(slab, m_TileSize);
    while (!tiles.empty())
    {
      m_Window.MoveTo(sites, client);
      MedialVoxelTileSchedule schedule(std::move(tiles));
      client.RunTiles(schedule);
      schedule.RethrowFailure();
      tiles = schedule.GetDeferredTiles();
      sites = sites.Union(schedule.GetNeededBox());
    }
    // What one slab needed, the next one probably needs too.
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t below = slab.lower[axis] - sites.lower[axis];
      const std::int64_t above = sites.upper[axis] - slab.upper[axis] - m_Settings.upperMargin[axis];
      m_Halo[axis] = std::max(m_Halo[axis], std::max(below, above));
    }
  }
}

} // end namespace itk
