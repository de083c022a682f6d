// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceObserver.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <utility>

namespace itk
{

MedialVoxelSurfacePieceError::MedialVoxelSurfacePieceError()
  : std::runtime_error("The medial surface has too many cells for pieces of this size.")
{}

MedialVoxelSurfaceObserver::MedialVoxelSurfaceObserver(const MedialVoxelGrid &                      grid,
                                                       const MedialVoxelParameters &                parameters,
                                                       const MedialVoxelGrid::SpacingType &         spacing,
                                                       const MedialVoxelSurfaceBuilder::Placement & placement,
                                                       MedialVoxelSurfaceConsumer &                 consumer)
  : m_Kernel(grid, parameters, spacing)
  , m_Builder(placement, spacing, consumer)
  , m_Trimmer(m_Builder)
{}

void
MedialVoxelSurfaceObserver::MeasureOnGrayValues(const double lower, const double upper)
{
  m_Kernel.MeasureOnGrayValues(lower, upper);
  m_Builder.SetWeightOfPlane(MedialVoxelSurfaceBuilder::WeightOfGrayPlane);
}

std::uint64_t
MedialVoxelSurfaceObserver::GetWorkerBytesPerVoxel(const MedialVoxelParameters & parameters)
{
  return MedialVoxelSurfaceCrossings::GetBytesPerVoxel(parameters) + MedialVoxelCellRow::BytesPerVoxel +
         sizeof(MedialVoxelSurfaceCell) / 16;
}

void
MedialVoxelSurfaceObserver::Begin()
{
  m_Pending.clear();
  m_NumberOfPending = 0;
}

MedialVoxelBox
MedialVoxelSurfaceObserver::Observe(const MedialVoxelClassifiedTile & tile)
{
  std::unique_ptr<Worker> worker = this->TakeWorker();
  const MedialVoxelBox    missing = m_Kernel.Find(tile, worker->workspace, worker->cells);
  if (!missing.IsEmpty())
  {
    worker->cells.clear();
  }
  this->TakeOver(std::move(worker));
  return missing;
}

auto
MedialVoxelSurfaceObserver::TakeWorker() -> std::unique_ptr<Worker>
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (m_Workers.empty())
  {
    return std::make_unique<Worker>();
  }
  std::unique_ptr<Worker> worker = std::move(m_Workers.back());
  m_Workers.pop_back();
  return worker;
}

/** Sort the cells of a tile into the slices; the worker serves the next tile. */
void
MedialVoxelSurfaceObserver::TakeOver(std::unique_ptr<Worker> worker)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  for (const MedialVoxelSurfaceCell & cell : worker->cells)
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
    m_Pending[slice].push_back(cell);
  }
  m_NumberOfPending += worker->cells.size();
  m_Workers.push_back(std::move(worker));
  if (m_NumberOfPending > m_MaximumNumberOfCells && m_Pending.size() > 1)
  {
    throw MedialVoxelSurfacePieceError();
  }
}

void
MedialVoxelSurfaceObserver::Commit()
{
  m_Workers.clear();
  for (std::size_t slice = 0; slice < m_Pending.size(); ++slice)
  {
    MedialVoxelPoll();
    auto & cells = m_Pending[slice];
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
