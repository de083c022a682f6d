// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSlabPlan.h"

#include "itkMedialVoxelClassifier.h"
#include "itkMedialVoxelDistanceTransform.h"
#include "itkMedialVoxelLengthTask.h"
#include "itkMedialVoxelMemoryShortage.h"
#include "itkMedialVoxelTileBalance.h"

#include <algorithm>
#include <utility>

namespace itk
{

namespace
{

/** Fewest tiles of a slab, in total and for each thread; with fewer, threads would wait for each other. */
constexpr std::int64_t EnoughTiles = 64;
constexpr std::int64_t EnoughTilesOfWorker = 4;

/** Edges of the tiles along y and z, and along x where walls are thin. */
constexpr std::int64_t SmallestTileEdge = 32;
constexpr std::int64_t LargestTileEdge = 96;
constexpr std::int64_t NarrowTile = 128;

/** Halo from which walls are thick. */
constexpr std::int64_t ThickHalo = 64;

/** Tiles of thick parts. */
constexpr std::int64_t WidestTile = 1024;
constexpr std::int64_t LargestWideEdge = 128;
constexpr std::int64_t WideTileArea = 65536;
constexpr std::int64_t WideTileSlices = 16;

/** Workers from which tiles of thick parts are half as thick, and half as wide. */
constexpr unsigned int ManyWorkers = 8;
constexpr unsigned int VeryManyWorkers = 32;

/** Voxels of tiles of whole rows, for several workers and for a single one, and their slices. */
constexpr std::int64_t VoxelsOfTiles = std::int64_t{ 1 } << 20;
constexpr std::int64_t VoxelsOfOnlyTile = 4 * VoxelsOfTiles;
constexpr std::int64_t SlicesOfRows = 16;

std::int64_t
CeilingDivide(const std::int64_t value, const std::int64_t divisor)
{
  return (value + divisor - 1) / divisor;
}

/** Tiles of thick parts: as much of the rows as is useful, because each tile repeats the search of its halo. */
MedialVoxelIndex
WideTile(const std::int64_t columns, const unsigned int numberOfWorkers)
{
  const std::int64_t parts = CeilingDivide(columns, WidestTile);
  const std::int64_t width =
    CeilingDivide(CeilingDivide(columns, parts), MedialVoxelBits::BitsPerWord) * MedialVoxelBits::BitsPerWord;
  const std::int64_t area = numberOfWorkers < VeryManyWorkers ? WideTileArea : WideTileArea / 2;
  const std::int64_t edge = area / width / SmallestTileEdge * SmallestTileEdge;
  const std::int64_t slices = numberOfWorkers < ManyWorkers ? WideTileSlices : WideTileSlices / 2;
  return { { std::max(width, NarrowTile), std::clamp(edge, SmallestTileEdge, LargestWideEdge), slices } };
}

/** Tiles of whole rows and of nearly equal size, because each tile searches the voxels beside it again. */
MedialVoxelIndex
TileOfRows(const MedialVoxelBox & region, const unsigned int numberOfWorkers)
{
  const auto divide = [](const std::int64_t extent, const std::int64_t most) {
    return CeilingDivide(extent, CeilingDivide(extent, most));
  };
  const std::int64_t width =
    CeilingDivide(region.Extent(0), MedialVoxelBits::BitsPerWord) * MedialVoxelBits::BitsPerWord;
  const std::int64_t voxels = numberOfWorkers == 1 ? VoxelsOfOnlyTile : VoxelsOfTiles;
  const std::int64_t rows = std::max(voxels / (width * SlicesOfRows), SmallestTileEdge);
  return { { width, divide(region.Extent(1), rows), divide(region.Extent(2), SlicesOfRows) } };
}

} // namespace

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

unsigned int
MedialVoxelSlowestAxis(const MedialVoxelBox & box)
{
  return box.Extent(2) > 1 ? 2u : (box.Extent(1) > 1 ? 1u : 0u);
}

MedialVoxelSlabPlan::Settings
MedialVoxelSlabPlan::Settings::ForClassification(const MedialVoxelGrid &       grid,
                                                 const MedialVoxelParameters & parameters,
                                                 const bool                    withObjectBoundary)
{
  Settings settings;
  settings.boundaries = { MedialVoxelBoundary::Background };
  if (withObjectBoundary)
  {
    settings.boundaries.push_back(MedialVoxelBoundary::Object);
  }
  settings.maximumPoreSize = parameters.maximumPoreSize;
  settings.upperMargin = grid.GetUnitMargin();
  // Boundary points of thin walls and the paths between them; thicker walls ask for more.
  const double           epsilon = parameters.GetLargestEpsilon();
  const MedialVoxelIndex reach = grid.MarginForMetricLength(0.5 * epsilon / grid.GetMetricUnit());
  if (parameters.mode == MedialVoxelThicknessMode::Automatic)
  {
    settings.tileMargin = MedialVoxelLocalThreshold(grid, parameters).GetMargin();
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    settings.halo[axis] += std::max(reach[axis], settings.tileMargin[axis]);
  }
  settings.bytesPerVoxel = settings.boundaries.size() * MedialVoxelFeatures::BytesPerVoxel + sizeof(std::uint8_t) +
                           MedialVoxelClassifier::GetBytesPerVoxel(grid, parameters);
  settings.bytesPerWorker = MedialVoxelClassifier::GetBytes(grid, parameters);
  return settings;
}

MedialVoxelSlabPlan::Settings
MedialVoxelSlabPlan::Settings::ForDistances(const MedialVoxelBoundary boundary)
{
  Settings settings;
  settings.boundaries = { boundary };
  settings.bytesPerVoxel = MedialVoxelFeatures::BytesPerVoxel;
  return settings;
}

MedialVoxelSlabPlan::Settings
MedialVoxelSlabPlan::Settings::ForLengths(const MedialVoxelBoundary boundary)
{
  Settings settings;
  settings.boundaries = { boundary };
  settings.findsLengthsOnly = true;
  return settings;
}

MedialVoxelSlabPlan::MedialVoxelSlabPlan(const MedialVoxelGrid & grid, Settings settings)
  : m_Grid(grid)
  , m_SlowestAxis(MedialVoxelSlowestAxis(grid.GetVoxelBox()))
  , m_Settings(std::move(settings))
  , m_Window(this->MakeWindow())
{}

MedialVoxelMovingWindow
MedialVoxelSlabPlan::MakeWindow() const
{
  return {
    m_Grid, m_Settings.boundaries, m_Settings.keepsNotANumber, m_Settings.keepsGray, m_Settings.maximumPoreSize
  };
}

MedialVoxelSlabPlan::Cut
MedialVoxelSlabPlan::PreferredCut(const MedialVoxelBox & region, const MedialVoxelIndex & halo) const
{
  Cut cut{ { { 256, 256, 1 } }, m_Settings.slabThickness, halo };
  if (m_Settings.tileSize > 0)
  {
    cut.tileSize.fill(m_Settings.tileSize);
  }
  else if (m_Grid.IsActive(2) && m_Settings.findsLengthsOnly)
  {
    cut.tileSize = TileOfRows(region, m_Settings.numberOfWorkers);
  }
  else if (m_Grid.IsActive(2) && m_Settings.preferredTileEdge > 0)
  {
    cut.tileSize = { { NarrowTile, m_Settings.preferredTileEdge, m_Settings.preferredTileEdge } };
  }
  else if (m_Grid.IsActive(2) && m_Grid.HasEqualSpacing() && std::max(halo[1], halo[2]) >= ThickHalo)
  {
    cut.tileSize = WideTile(region.Extent(0), m_Settings.numberOfWorkers);
  }
  else if (m_Grid.IsActive(2))
  {
    // Whole words along x. Features of thin parts fit the second-level cache; tiles of thick parts grow with their halo
    // and margin, because a tile repeats the work of both.
    const std::int64_t smallest = m_Settings.tileMargin[1] > 0 ? 64 : SmallestTileEdge;
    const std::int64_t edge =
      std::clamp(std::max(halo[1], halo[2]) / SmallestTileEdge * SmallestTileEdge, smallest, LargestTileEdge);
    cut.tileSize = { { NarrowTile, edge, edge } };
  }
  if (cut.slabThickness <= 0)
  {
    std::int64_t tilesPerLayer = 1;
    for (unsigned int axis = 0; axis < m_SlowestAxis; ++axis)
    {
      tilesPerLayer *= CeilingDivide(region.Extent(axis), cut.tileSize[axis]);
    }
    const std::int64_t enough =
      std::max(m_Settings.findsLengthsOnly ? 1 : EnoughTiles, EnoughTilesOfWorker * m_Settings.numberOfWorkers);
    cut.slabThickness = cut.tileSize[m_SlowestAxis] * CeilingDivide(enough, tilesPerLayer);
  }
  return cut;
}

bool
MedialVoxelSlabPlan::MakeFiner(Cut & cut) const
{
  // Smaller tiles and thinner slabs both repeat more work of the halo, but only more tiles keep threads busy.
  std::int64_t & edge = cut.tileSize[1];
  if (m_Settings.tileSize <= 0 && m_SlowestAxis == 2 && edge > SmallestTileEdge)
  {
    edge = std::max(edge - SmallestTileEdge, SmallestTileEdge);
    cut.tileSize[2] = std::min(cut.tileSize[2], edge);
    return true;
  }
  if (cut.slabThickness > 1)
  {
    cut.slabThickness = (cut.slabThickness + 1) / 2;
    return true;
  }
  return false;
}

MedialVoxelSlabPlan::Cut
MedialVoxelSlabPlan::ChooseCut(const MedialVoxelBox & region, const MedialVoxelIndex & halo) const
{
  Cut cut = this->PreferredCut(region, halo);
  while (!this->IsWithinLimit(this->GetBytes(this->LargestSitesBox(region, cut), cut)))
  {
    if (this->MakeFiner(cut))
    {
      continue;
    }
    // Bounds of distances are coarse, so a smaller halo may suffice.
    const std::int64_t largest = *std::max_element(cut.halo.begin(), cut.halo.end());
    if (largest == 0)
    {
      throw MedialVoxelMemoryShortage(this->GetBytes(this->LargestSitesBox(region, cut), cut), m_Settings.memoryLimit);
    }
    for (std::int64_t & voxels : cut.halo)
    {
      voxels = std::min(voxels, largest - 1);
    }
  }
  return cut;
}

unsigned int
MedialVoxelSlabPlan::CountWorkers(const MedialVoxelBox & region, const MedialVoxelIndex & halo) const
{
  if (region.IsEmpty())
  {
    return 1;
  }
  // Many workers split tiles.
  MedialVoxelIndex tileSize = this->ChooseCut(region, halo).tileSize;
  for (unsigned int axis = 1; axis < 3 && m_Settings.numberOfWorkers >= MedialVoxelTileBalance::ManyWorkers; ++axis)
  {
    tileSize[axis] = std::min(tileSize[axis], SmallestTileEdge);
  }
  std::int64_t tiles = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    tiles *= (region.upper[axis] - 1) / tileSize[axis] - region.lower[axis] / tileSize[axis] + 1;
  }
  return static_cast<unsigned int>(std::clamp<std::int64_t>(tiles, 1, std::max(1u, m_Settings.numberOfWorkers)));
}

MedialVoxelBox
MedialVoxelSlabPlan::GetSlab(const MedialVoxelBox & region,
                             const std::int64_t     position,
                             const std::int64_t     thickness) const
{
  MedialVoxelBox slab = region;
  slab.lower[m_SlowestAxis] = position;
  slab.upper[m_SlowestAxis] = std::min((position / thickness + 1) * thickness, region.upper[m_SlowestAxis]);
  return slab;
}

MedialVoxelBox
MedialVoxelSlabPlan::GetSitesBox(const MedialVoxelBox & slab, const MedialVoxelIndex & halo) const
{
  MedialVoxelBox voxels = slab;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    voxels.upper[axis] += m_Settings.upperMargin[axis];
  }
  return voxels.Expanded(halo).Intersection(m_Grid.GetVoxelBox());
}

MedialVoxelBox
MedialVoxelSlabPlan::LargestSitesBox(const MedialVoxelBox & region, const Cut & cut) const
{
  MedialVoxelBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t size = m_Grid.GetVoxelBox().upper[axis];
    const std::int64_t ofSlab =
      axis == m_SlowestAxis ? std::min(cut.slabThickness, region.Extent(axis)) : region.Extent(axis);
    const std::int64_t extent = std::min(ofSlab + m_Settings.upperMargin[axis] + 2 * cut.halo[axis], size);
    // Away from the borders, and from the first bit of a word, a box takes most.
    box.lower[axis] = std::min(MedialVoxelBits::BitsPerWord - 1, (size - extent) / 2);
    box.upper[axis] = box.lower[axis] + extent;
  }
  return box;
}

std::uint64_t
MedialVoxelSlabPlan::BytesOfWorkers(const MedialVoxelBox & sites, const Cut & cut) const
{
  MedialVoxelIndex tile;
  std::uint64_t    tileVoxels = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t edge =
      axis == m_SlowestAxis ? std::min(cut.tileSize[axis], cut.slabThickness) : cut.tileSize[axis];
    tile[axis] = std::min(edge + m_Settings.upperMargin[axis] + 2 * m_Settings.tileMargin[axis], sites.Extent(axis));
    tileVoxels *= static_cast<std::uint64_t>(tile[axis]);
  }
  if (m_Settings.boundaries.empty())
  {
    return m_Settings.numberOfWorkers * (m_Settings.bytesPerWorker + tileVoxels * m_Settings.bytesPerVoxel);
  }
  // Beside the end of the image a tile can search as far as the window reaches on its other side.
  const std::int64_t reach = sites.Extent(m_SlowestAxis) - tile[m_SlowestAxis];
  const double       length = static_cast<double>(reach + 1) * m_Grid.GetMetricSpacing()[m_SlowestAxis];
  const auto         margin = m_Grid.MarginForMetricLength(length);
  const bool         isAllKnown = sites.Extent(m_SlowestAxis) == m_Grid.GetSize()[m_SlowestAxis];
  MedialVoxelIndex   searched;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    searched[axis] = isAllKnown ? sites.Extent(axis) : std::min(tile[axis] + 2 * margin[axis], sites.Extent(axis));
  }
  const std::uint64_t search =
    m_Settings.findsLengthsOnly
      ? MedialVoxelDistanceTransform::GetBytes(tile, searched) + MedialVoxelLengthTask::GetBytes(m_Grid, searched)
      : MedialVoxelFeatureTransform::GetBytes(m_Grid, tile, searched);
  const std::uint64_t worker = m_Settings.bytesPerWorker + tileVoxels * m_Settings.bytesPerVoxel + search;
  return m_Settings.numberOfWorkers * worker;
}

std::vector<MedialVoxelBox>
MedialVoxelSlabPlan::CutTiles(const std::vector<MedialVoxelBox> & parts, const Cut & cut)
{
  std::vector<MedialVoxelBox> tiles;
  for (const MedialVoxelBox & part : parts)
  {
    const auto tilesOfPart = MedialVoxelCutIntoTiles(part, cut.tileSize);
    tiles.insert(tiles.end(), tilesOfPart.begin(), tilesOfPart.end());
  }
  return tiles;
}

MedialVoxelIndex
MedialVoxelSlabPlan::WidenHalo(MedialVoxelIndex halo, const MedialVoxelBox & slab, const MedialVoxelBox & sites) const
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t below = slab.lower[axis] - sites.lower[axis];
    const std::int64_t above = sites.upper[axis] - slab.upper[axis] - m_Settings.upperMargin[axis];
    halo[axis] = std::max(halo[axis], std::max(below, above));
  }
  return halo;
}

} // end namespace itk
