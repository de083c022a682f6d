// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceObserver.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <utility>

namespace itk
{

namespace
{

/** Vectors that double would take twice the memory. */
void
Append(const MedialVoxelSurfaceCell & cell, std::vector<MedialVoxelSurfaceCell> & cells)
{
  if (cells.size() == cells.capacity())
  {
    constexpr std::size_t least = 64;
    cells.reserve(cells.size() + std::max(least, cells.size() / 4));
  }
  cells.push_back(cell);
}

} // namespace

struct MedialVoxelSurfaceObserver::Worker : public Workspace
{
  MedialVoxelSurfaceCells::Workspace  kernel;
  std::vector<MedialVoxelSurfaceCell> cells;
};

MedialVoxelSurfacePieceError::MedialVoxelSurfacePieceError()
  : std::runtime_error("The medial surface has too many cells for pieces of this size.")
{}

MedialVoxelSurfaceObserver::MedialVoxelSurfaceObserver(const MedialVoxelGrid &              grid,
                                                       const MedialVoxelParameters &        parameters,
                                                       const MedialVoxelGrid::SpacingType & spacing,
                                                       const MedialVoxelSurfacePlacement &  placement,
                                                       MedialVoxelSurfaceConsumer &         consumer)
  : m_WorkerBytesPerVoxel(GetWorkerBytesPerVoxel(grid, parameters))
  , m_Kernel(grid, parameters, spacing)
  , m_Builder(placement, spacing, consumer)
  , m_Trimmer(m_Builder)
{}

void
MedialVoxelSurfaceObserver::MeasureOnGrayValues(const MedialVoxelExtraction::GrayRange & range)
{
  m_Kernel.MeasureOnGrayValues(range);
  m_Builder.SetWeightOfPlane(MedialVoxelSurfaceBuilder::WeightOfGrayPlane);
}

std::uint64_t
MedialVoxelSurfaceObserver::GetWorkerBytesPerVoxel(const MedialVoxelGrid &       grid,
                                                   const MedialVoxelParameters & parameters)
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
  for (const MedialVoxelSurfaceCell & cell : cells)
  {
    const std::int32_t z = cell.index[2];
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
    Append(cell, m_Pending[slice]);
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
  for (std::size_t slice = 0; slice < m_Pending.size(); ++slice)
  {
    MedialVoxelPoll();
    auto & cells = m_Pending[slice];
    if (m_FindPart)
    {
      for (MedialVoxelSurfaceCell & cell : cells)
      {
        cell.part = m_FindPart({ { cell.index[0], cell.index[1], cell.index[2] } });
      }
    }
    std::sort(cells.begin(), cells.end(), MedialVoxelIsBefore);
    m_Trimmer.AddSlice(m_FirstSlice + static_cast<std::int64_t>(slice), std::move(cells));
  }
  this->Begin();
}

void
MedialVoxelSurfaceObserver::Finish()
{
  m_Trimmer.Finish();
}

} // end namespace itk
