// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClusterEngine.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace itk
{

namespace
{

/** Tiles of a slab below which threads would wait for each other. */
constexpr std::int64_t EnoughTiles = 64;

/** Edges of the tiles along y and z. */
constexpr std::int64_t SmallestTileEdge = 32;
constexpr std::int64_t LargestTileEdge = 96;

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
  , m_Halo(m_Settings.halo)
  , m_Window(grid, m_Settings.boundaries, m_Settings.keepsNotANumber)
{}

MedialVoxelIndex
MedialVoxelClusterEngine::ChooseTileSize() const
{
  if (m_Settings.tileSize > 0)
  {
    return { { m_Settings.tileSize, m_Settings.tileSize, m_Settings.tileSize } };
  }
  if (!m_Grid.IsActive(2))
  {
    return { { 256, 256, 1 } };
  }
  // Whole words along x. Features of thin parts fit the second-level cache; tiles of thick parts grow with their halo,
  // as a tile repeats the work of the halo around it.
  const std::int64_t halo = std::max(m_Halo[1], m_Halo[2]);
  const std::int64_t edge =
    std::min(LargestTileEdge, std::max(SmallestTileEdge, halo / SmallestTileEdge * SmallestTileEdge));
  return { { 128, edge, edge } };
}

MedialVoxelBox
MedialVoxelClusterEngine::GetSlab(const MedialVoxelBox & region, const std::int64_t position) const
{
  const unsigned int     axis = MedialVoxelSlowestAxis(m_Grid.GetVoxelBox());
  const MedialVoxelIndex tileSize = this->ChooseTileSize();
  std::int64_t           thickness = m_Settings.slabThickness;
  if (thickness <= 0)
  {
    std::int64_t tilesPerLayer = 1;
    for (unsigned int other = 0; other < axis; ++other)
    {
      tilesPerLayer *= CeilingDivide(region.Extent(other), tileSize[other]);
    }
    thickness = tileSize[axis] * CeilingDivide(EnoughTiles, tilesPerLayer);
  }
  MedialVoxelBox slab = region;
  slab.lower[axis] = position;
  slab.upper[axis] = std::min((position / thickness + 1) * thickness, region.upper[axis]);
  return slab;
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

std::vector<MedialVoxelBox>
MedialVoxelClusterEngine::GetMissingObjectBoxes(const MedialVoxelBox & region) const
{
  const MedialVoxelBox slab = this->GetSlab(region, region.lower[MedialVoxelSlowestAxis(m_Grid.GetVoxelBox())]);
  return MedialVoxelSubtractBox(m_Window.GetObjectBox(this->GetSitesBox(slab)), m_Window.GetObject().GetBox());
}

void
MedialVoxelClusterEngine::Run(const MedialVoxelBox & region, MedialVoxelClusterClient & client)
{
  const unsigned int axis = MedialVoxelSlowestAxis(m_Grid.GetVoxelBox());
  for (std::int64_t position = region.lower[axis]; position < region.upper[axis];)
  {
    const MedialVoxelBox slab = this->GetSlab(region, position);
    this->RunSlab(slab, client);
    position = slab.upper[axis];
  }
}

void
MedialVoxelClusterEngine::RunSlab(const MedialVoxelBox & slab, MedialVoxelClusterClient & client)
{
  MedialVoxelBox              sites = this->GetSitesBox(slab);
  std::vector<MedialVoxelBox> tiles = MedialVoxelCutIntoTiles(slab, this->ChooseTileSize());
  while (!tiles.empty())
  {
    m_Window.MoveTo(sites, client);
    MedialVoxelTileSchedule schedule(std::move(tiles));
    client.RunTiles(schedule);
    schedule.RethrowFailure();
    tiles = schedule.GetDeferredTiles();
    if (!tiles.empty() && sites.Contains(schedule.GetNeededBox()))
    {
      throw std::logic_error("MedialVoxelClusterEngine: a tile was deferred although its window holds what it needs");
    }
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

} // end namespace itk
