// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceSurvey.h"

#include "itkMedialVoxelTileWalls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace medialvoxel
{
namespace
{

constexpr double        LengthUnitsPerVoxel = 65536.0;
constexpr double        FacesOfSmallestPlace = 10.0;
constexpr double        AreaUnitsPerFace = 1048576.0; // as in a survey
constexpr std::uint64_t VoxelsPerOpenCell = 16;       // of a slice

double
GetLengthUnit(const itk::MedialVoxelGrid & grid, unsigned int dimension)
{
  const auto & spacing = grid.GetSpacing();
  return *std::min_element(spacing.begin(), spacing.begin() + dimension) / LengthUnitsPerVoxel;
}

/** Memory of the planned cells of a slice: new ones, and cells of two open slices. */
std::uint64_t
GetPlannedCellMemory(const VolumeGeometry & geometry)
{
  constexpr std::uint64_t least = 1024;
  const std::uint64_t     cells = least + geometry.GetVoxelsPerSlice() / VoxelsPerOpenCell;
  return cells * (PlaceJoiner::CellSize + 2 * PlaceJoiner::OpenCellSize);
}

/** Places of a kind that are listed, at most: no two of them touch. */
std::uint64_t
GetMostPlaces(const VolumeGeometry & geometry, const PlaceLimits & limits)
{
  // Places with the voxels behind their cells do not overlap: ten cells have (10^(1/3) + 1)^3, or (10^(1/2) + 1)^2.
  const std::uint64_t voxelsOfTenCells = geometry.GetDimension() == 3 ? 31 : 17;
  const std::uint64_t voxelsOfCell = std::uint64_t{ 1 } << geometry.GetDimension();
  const std::uint64_t places = geometry.GetNumberOfVoxels() / (limits.leastArea ? voxelsOfCell : voxelsOfTenCells) + 1;
  return std::min<std::uint64_t>(places, PlaceList::MostPlaces);
}

} // namespace

PlaceMemoryError::PlaceMemoryError(std::uint64_t allowedBytes)
  : std::runtime_error("thin or thick places take more memory than is planned")
  , m_AllowedBytes(allowedBytes)
{}

PlaceSurvey::PlaceSurvey(const VolumeGeometry &       geometry,
                         const itk::MedialVoxelGrid & grid,
                         const PlaceSettings &        settings,
                         double                       areaUnit,
                         std::uint64_t                surplus)
  : m_Geometry(geometry)
  , m_Grid(grid.GetSize(), geometry.GetDimension())
  , m_AreaUnit(areaUnit)
  , m_AllowedBytes(GetPlannedCellMemory(geometry) + surplus)
{
  for (const auto & [kind, limits] : settings)
  {
    const double smallest = limits.leastArea.value_or(FacesOfSmallestPlace * AreaUnitsPerFace * areaUnit) / areaUnit;
    PlaceRule    rule;
    rule.kind = kind;
    rule.limit = static_cast<float>(limits.limit);
    rule.growLimit = static_cast<float>(limits.GetGrowLimit(kind));
    rule.minimumPlaceArea =
      smallest < 0x1p63 ? static_cast<std::uint64_t>(std::ceil(smallest)) : std::numeric_limits<std::uint64_t>::max();
    rule.lengthUnit = GetLengthUnit(grid, geometry.GetDimension());
    m_Searches.push_back({ limits, PlaceJoiner(rule, m_Grid), {} });
  }
}

void
PlaceSurvey::Begin()
{
  for (Search & search : m_Searches)
  {
    search.pending.clear();
  }
}

itk::MedialVoxelBits::WordType
PlaceSurvey::SelectCells(const itk::MedialVoxelCellRow &) const
{
  return ~itk::MedialVoxelBits::WordType{ 0 };
}

void
PlaceSurvey::Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace *)
{
  for (Search & search : m_Searches)
  {
    const PlaceRule &      rule = search.joiner.GetRule();
    std::vector<PlaceCell> cells;
    itk::MedialVoxelForEachWall(tile.rows, tile.walls, [&](const auto & index, const auto & wall) {
      if (!wall.IsMeasured() || !rule.Grows(wall.thickness))
      {
        return;
      }
      PlaceCell cell{ m_Grid.GetKey(index), wall.thickness };
      cell.area = static_cast<std::uint32_t>(std::llround(static_cast<double>(wall.area) / m_AreaUnit));
      cell.uncertainty = wall.uncertainty;
      if (rule.Begins(wall.thickness))
      {
        TakeSides(cell, tile, index);
      }
      cells.push_back(cell);
    });
    const std::lock_guard<std::mutex> lock(m_Mutex);
    search.pending.insert(search.pending.end(), cells.begin(), cells.end());
    if (this->GetUsedMemory() > m_AllowedBytes)
    {
      throw PlaceMemoryError(m_AllowedBytes);
    }
  }
}

std::uint64_t
PlaceSurvey::GetUsedMemory() const
{
  return std::accumulate(
    m_Searches.begin(), m_Searches.end(), std::uint64_t{ 0 }, [](std::uint64_t bytes, const Search & search) {
      return bytes + search.joiner.GetOpenMemory() + search.pending.size() * PlaceJoiner::CellSize;
    });
}

void
PlaceSurvey::Commit()
{
  for (Search & search : m_Searches)
  {
    search.joiner.Add(search.pending, m_Region);
    search.pending = {};
  }
}

void
PlaceSurvey::Clear()
{
  for (Search & search : m_Searches)
  {
    search.joiner.Clear();
  }
}

std::string
PlaceSurvey::Save() const
{
  NumberWriter numbers;
  for (const Search & search : m_Searches)
  {
    search.joiner.Save(numbers);
  }
  return numbers.Pack();
}

void
PlaceSurvey::Merge(const std::string & bytes)
{
  // zlib makes no byte from less than a thousandth of one.
  constexpr std::uint64_t mostPacking = 1100;
  NumberReader            numbers(bytes, bytes.size() * mostPacking);
  for (Search & search : m_Searches)
  {
    search.joiner.Merge(numbers);
  }
  numbers.CheckEnd();
}

std::vector<PlaceSummary>
PlaceSurvey::Summarize() const
{
  std::vector<PlaceSummary> summaries;
  for (const Search & search : m_Searches)
  {
    const PlaceRule & rule = search.joiner.GetRule();
    PlaceList         list = search.joiner.Finish();
    PlaceSummary &    summary = summaries.emplace_back();
    summary.kind = rule.kind;
    summary.dimension = m_Geometry.GetDimension();
    summary.limit = search.limits.limit;
    summary.growLimit = search.limits.GetGrowLimit(rule.kind);
    summary.minimumPlaceArea = static_cast<double>(rule.minimumPlaceArea) * m_AreaUnit;
    summary.number = list.GetTotals().number;
    summary.cells = list.GetTotals().cells;
    summary.area = static_cast<double>(list.GetTotals().area) * m_AreaUnit;
    summary.areaBeyond = static_cast<double>(list.GetTotals().areaBeyond) * m_AreaUnit;
    summary.smaller = list.GetTotals().smaller;
    const std::vector<PlaceSums> sorted = list.TakeSorted();
    summary.places.reserve(sorted.size());
    for (const PlaceSums & sums : sorted)
    {
      summary.places.push_back(this->Describe(sums, rule.lengthUnit));
    }
  }
  return summaries;
}

WallPlace
PlaceSurvey::Describe(const PlaceSums & sums, double lengthUnit) const
{
  WallPlace place{ LocateWall(sums.worst, m_Grid, m_Geometry) };
  place.cells = sums.cells;
  place.area = static_cast<double>(sums.area) * m_AreaUnit;
  place.areaBeyond = static_cast<double>(sums.areaBeyond) * m_AreaUnit;
  place.minimum = static_cast<double>(sums.minimum);
  place.mean = static_cast<double>(sums.thickness) * lengthUnit / static_cast<double>(sums.cells);
  place.maximum = static_cast<double>(sums.maximum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    place.first[axis] = sums.first[axis];
    place.last[axis] = sums.last[axis];
  }
  return place;
}

ProductFootprint
PlaceSurvey::GetFootprint(const VolumeGeometry & geometry, const PlaceSettings & settings)
{
  // The places that are listed, sorted, described and as text.
  constexpr std::uint64_t bytesOfText = 256;
  constexpr std::uint64_t bytesPerPlace = 2 * sizeof(PlaceSums) + sizeof(WallPlace) + bytesOfText;
  std::uint64_t           bytes = GetPlannedCellMemory(geometry);
  for (const auto & [kind, limits] : settings)
  {
    bytes += GetMostPlaces(geometry, limits) * bytesPerPlace;
  }
  // Three cases: all walls of a piece are thin and noisy; walls are thin here and there; a thin wall lies in a slice,
  // which then has many cells at once. Cells get half of the memory beside the walls.
  const PieceSurplus surplus{ 8, 1, PlaceJoiner::CellSize + 2 * PlaceJoiner::OpenCellSize, 2 };
  return { bytes, bytes, PerVoxelOfTile, surplus };
}

} // end namespace medialvoxel
