// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceObserver.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace itk
{

namespace
{

using CellVector = std::vector<MedialVoxelSurfaceCell>;

/** Cells of a slice up to which time matters more than memory, for growing and for sorting with a copy. */
constexpr std::size_t MostCellsOfSmallSlice = std::size_t{ 1 } << 16;

/** Vectors that double would take twice the memory. */
void
Append(const CellVector::const_iterator first, const CellVector::const_iterator last, CellVector & cells)
{
  const std::size_t size = cells.size() + static_cast<std::size_t>(last - first);
  if (size > cells.capacity())
  {
    constexpr std::size_t least = 64;
    const std::size_t     surplus = cells.size() / (size <= MostCellsOfSmallSlice ? 4 : 8);
    cells.reserve(std::max({ size, cells.size() + surplus, least }));
  }
  cells.insert(cells.end(), first, last);
}

/** Sorts the cells of a slice, which come in pieces whose rows are sorted. */
void
SortSlice(CellVector & cells)
{
  if (std::is_sorted(cells.begin(), cells.end(), MedialVoxelIsBefore))
  {
    return;
  }
  if (cells.size() > MostCellsOfSmallSlice)
  {
    std::sort(cells.begin(), cells.end(), MedialVoxelIsBefore);
    return;
  }
  const auto isBelow = [](const MedialVoxelSurfaceCell & a, const MedialVoxelSurfaceCell & b) {
    return a.index[1] < b.index[1];
  };
  const auto [lowest, highest] = std::minmax_element(cells.begin(), cells.end(), isBelow);
  const std::int32_t       first = lowest->index[1];
  std::vector<std::size_t> ends(static_cast<std::size_t>(highest->index[1] - first) + 2);
  for (const MedialVoxelSurfaceCell & cell : cells)
  {
    ++ends[static_cast<std::size_t>(cell.index[1] - first) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  CellVector sorted(cells.size());
  for (const MedialVoxelSurfaceCell & cell : cells)
  {
    sorted[ends[static_cast<std::size_t>(cell.index[1] - first)]++] = cell;
  }
  auto begin = sorted.begin();
  for (const std::size_t end : ends)
  {
    const auto endOfRow = sorted.begin() + static_cast<std::ptrdiff_t>(end);
    if (!std::is_sorted(begin, endOfRow, MedialVoxelIsBefore))
    {
      std::sort(begin, endOfRow, MedialVoxelIsBefore);
    }
    begin = endOfRow;
  }
  cells.swap(sorted);
}

} // namespace

struct MedialVoxelSurfaceObserver::Worker : public Workspace
{
  MedialVoxelSurfaceCells::Workspace  kernel;
  std::vector<MedialVoxelSurfaceCell> cells;
};

MedialVoxelSurfacePieceError::MedialVoxelSurfacePieceError()
  : std::runtime_error("the medial surface has more cells than fit into the memory that is allowed")
{}

MedialVoxelSurfaceObserver::MedialVoxelSurfaceObserver(const MedialVoxelGrid &              grid,
                                                       const MedialVoxelParameters &        parameters,
                                                       const MedialVoxelGrid::SpacingType & spacing,
                                                       const MedialVoxelSurfacePlacement &  placement,
                                                       MedialVoxelSurfaceConsumer &         consumer)
  : m_BytesPerVoxel(GetBytesPerVoxel(grid, parameters))
  , m_Kernel(grid, parameters, spacing)
  , m_Builder(placement, spacing, consumer)
  , m_Trimmer(m_Builder)
{}

void
MedialVoxelSurfaceObserver::MeasureOnGrayValues(const MedialVoxelSheetExtraction::GrayRange & range)
{
  m_Kernel.MeasureOnGrayValues(range);
  m_Builder.SetWeightOfPlane(MedialVoxelSurfaceBuilder::WeightOfGrayPlane);
}

std::uint64_t
MedialVoxelSurfaceObserver::GetBytesPerVoxel(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
{
  return MedialVoxelSurfaceCrossings::GetBytesPerVoxel(grid, parameters) + MedialVoxelCellRow::BytesPerVoxel +
         sizeof(MedialVoxelSurfaceCell) / 16;
}

void
MedialVoxelSurfaceObserver::Begin()
{
  m_Pending.clear();
  m_NumberOfPending = 0;
}

auto
MedialVoxelSurfaceObserver::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return std::make_unique<Worker>();
}

MedialVoxelBox
MedialVoxelSurfaceObserver::Examine(const MedialVoxelClassifiedTile & tile, Workspace * const workspace) const
{
  auto & worker = static_cast<Worker &>(*workspace);
  return m_Kernel.Find(tile, worker.kernel, worker.cells);
}

/** Sort the cells of the tile into the slices. */
void
MedialVoxelSurfaceObserver::Observe(const MedialVoxelClassifiedTile &, Workspace * const workspace)
{
  const auto &                      cells = static_cast<const Worker &>(*workspace).cells;
  const std::lock_guard<std::mutex> lock(m_Mutex);
  for (auto first = cells.begin(); first != cells.end();)
  {
    const std::int32_t z = first->index[2];
    const auto         last =
      std::find_if(first, cells.end(), [=](const MedialVoxelSurfaceCell & cell) { return cell.index[2] != z; });
    if (m_Pending.empty())
    {
      m_FirstSlice = z;
    }
    if (z < m_FirstSlice)
    {
      m_Pending.insert(m_Pending.begin(), static_cast<std::size_t>(m_FirstSlice - z), {});
      m_FirstSlice = z;
    }
    const auto slice = static_cast<std::size_t>(z - m_FirstSlice);
    if (slice >= m_Pending.size())
    {
      m_Pending.resize(slice + 1);
    }
    Append(first, last, m_Pending[slice]);
    first = last;
  }
  m_NumberOfPending += cells.size();
  if (m_NumberOfPending > m_MaximumNumberOfCells && m_Pending.size() > 1)
  {
    throw MedialVoxelSurfacePieceError();
  }
}

void
MedialVoxelSurfaceObserver::Commit()
{
  for (CellVector & cells : m_Pending)
  {
    for (MedialVoxelSurfaceCell & cell : cells)
    {
      cell.part = m_FindPart ? m_FindPart({ { cell.index[0], cell.index[1], cell.index[2] } }) : cell.part;
    }
  }
  m_Builder.GetRunTasks()(m_Pending.size(), [this](const std::size_t slice) { SortSlice(m_Pending[slice]); });
  for (std::size_t slice = 0; slice < m_Pending.size(); ++slice)
  {
    MedialVoxelCheckAbort();
    m_Trimmer.AddSlice(m_FirstSlice + static_cast<std::int64_t>(slice), std::move(m_Pending[slice]));
  }
  this->Begin();
}

void
MedialVoxelSurfaceObserver::Finish()
{
  m_Trimmer.Finish();
}

} // end namespace itk
