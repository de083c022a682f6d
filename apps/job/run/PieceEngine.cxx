// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceEngine.h"

#include <cstring>
#include <new>
#include <utility>
#include <variant>

namespace medialvoxel
{

itk::MedialVoxelEngineSettings
MakeEngineSettings(const VolumeHeader & header, const itk::MedialVoxelEngineTask & task)
{
  const PixelType                type = header.GetValueType();
  itk::MedialVoxelEngineSettings settings;
  settings.task = task;
  settings.countsNotANumber = type == PixelType::Float32 || type == PixelType::Float64;
  return settings;
}

void
PieceEngine::Buffer::Reserve(std::uint64_t bytes)
{
  if (m_Size < bytes)
  {
    // First, or there would be two of them.
    this->Release();
    // Zeros take no memory before something is written.
    m_Bytes.reset(static_cast<std::byte *>(std::calloc(bytes, 1)));
    if (!m_Bytes)
    {
      throw std::bad_alloc();
    }
    m_Size = bytes;
  }
}

void
PieceEngine::Buffer::Release()
{
  m_Bytes.reset();
  m_Size = 0;
}

void
PieceEngine::Buffer::Clear()
{
  std::memset(m_Bytes.get(), 0, m_Size);
}

PieceEngine::PieceEngine(itk::MedialVoxelObjectSource &     input,
                         const VolumeHeader &               header,
                         const JobOptions &                 options,
                         const JobPlan &                    plan,
                         const itk::MedialVoxelEngineTask & task,
                         const PieceObserver &              observer)
  : m_Input(input)
  , m_Geometry(header.geometry)
  , m_SkipsEmptyPieces(options.sparse)
  , m_Grid(GetGrid(header))
  , m_Settings(MakeEngineSettings(header, task))
  , m_Observer(observer)
{
  m_Settings.slabThickness = static_cast<std::int64_t>(plan.slabThickness);
  m_Settings.memoryLimit = plan.GetEngineLimit(plan.GetSlicesAtOnce());
  m_Settings.numberOfWorkers = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  m_Settings.readsAhead = plan.readsAhead;
}

bool
PieceEngine::MakesLabels() const
{
  return std::holds_alternative<itk::MedialVoxelSheetExtraction>(m_Settings.task);
}

const char *
PieceEngine::GetName() const
{
  struct Names
  {
    const char *
    operator()(const itk::MedialVoxelSheetExtraction &) const
    {
      return "labels";
    }

    const char *
    operator()(const itk::MedialVoxelDistanceMap &) const
    {
      return "distances";
    }

    const char *
    operator()(const itk::MedialVoxelLocalThickness &) const
    {
      return "local thickness";
    }
  };
  return std::visit(Names{}, m_Settings.task);
}

void
PieceEngine::AddVolume(const VolumeRequest & request, VoxelOutput & volume)
{
  m_Destinations.push_back({ request, &volume, {} });
}

void
PieceEngine::AddObserver(itk::MedialVoxelTileObserver & observer)
{
  std::get<itk::MedialVoxelSheetExtraction>(m_Settings.task).AddObserver(observer);
}

void
PieceEngine::SetGrayRange(const std::optional<itk::MedialVoxelSheetExtraction::GrayRange> & range)
{
  if (auto * const extraction = std::get_if<itk::MedialVoxelSheetExtraction>(&m_Settings.task))
  {
    extraction->grayRange = range;
  }
  auto * const thickness = std::get_if<itk::MedialVoxelLocalThickness>(&m_Settings.task);
  if (thickness != nullptr && thickness->walls)
  {
    thickness->walls->grayRange = range;
  }
}

void
PieceEngine::SetMemoryLimit(std::uint64_t bytes)
{
  m_Settings.memoryLimit = bytes;
  m_Engine.reset();
}

PieceResults
PieceEngine::Run(const PieceRange & range, const PieceRange & nextRange)
{
  m_Region = this->GetRegion(range);
  std::for_each(
    m_RegionListeners.begin(), m_RegionListeners.end(), [this](const auto & listener) { listener(m_Region); });
  this->PrepareBuffers();
  PieceResults results;
  for (const Destination & destination : m_Destinations)
  {
    results.parts.push_back({ destination.volume, destination.buffers[m_Set].Get() });
  }
  if (!m_Engine)
  {
    m_Engine = std::make_unique<itk::MedialVoxelEngine>(m_Grid, m_Settings);
  }
  try
  {
    results.sums = m_Engine->Run(m_Region, m_Input, *this, this->GetRegion(nextRange));
  }
  catch (...)
  {
    m_Engine.reset();
    throw;
  }
  if (nextRange.slices.begin == nextRange.slices.end && m_Engine->IsLast(m_Region))
  {
    // Nobody needs the window.
    m_Engine.reset();
  }
  const itk::MedialVoxelCounts & counts = results.sums.counts;
  if (m_SkipsEmptyPieces && this->MakesLabels() && counts.candidateCells == 0 && counts.objectVoxels == 0)
  {
    results.parts.clear();
  }
  // Not before: the results of the piece before may be in use when this one is tried again.
  m_Set = (m_Set + 1) % m_NumberOfSets;
  return results;
}

void
PieceEngine::PrepareBuffers()
{
  const bool mustClear = this->MakesLabels() && m_HasResults[m_Set].exchange(false);
  for (Destination & destination : m_Destinations)
  {
    Buffer & buffer = destination.buffers[m_Set];
    if (mustClear && buffer.Get() != nullptr)
    {
      buffer.Clear();
    }
    buffer.Reserve(static_cast<std::uint64_t>(m_Region.NumberOfVoxels()) * destination.request.layout.GetBytes());
  }
}

void
PieceEngine::Release()
{
  for (Destination & destination : m_Destinations)
  {
    for (Buffer & buffer : destination.buffers)
    {
      buffer.Release();
    }
  }
}

void
PieceEngine::RunWorkers(unsigned int numberOfWorkers, const std::function<void()> & work)
{
  m_Threader->SetNumberOfWorkUnits(static_cast<itk::ThreadIdType>(numberOfWorkers));
  m_Threader->ParallelizeArray(0, numberOfWorkers, [&work](itk::SizeValueType) { work(); }, nullptr);
}

void
PieceEngine::TakeTile(const itk::MedialVoxelTileResult & tile)
{
  if (tile.isEmpty)
  {
    return;
  }
  if (m_Taker)
  {
    m_Taker(tile);
    return;
  }
  m_HasResults[m_Set] = true;
  const itk::MedialVoxelStrides strides{ 1, m_Region.Extent(0), m_Region.Extent(0) * m_Region.Extent(1) };
  const std::size_t             offset = m_Region.OffsetOf(tile.box.lower);
  for (const Destination & destination : m_Destinations)
  {
    std::byte * const first = destination.buffers[m_Set].Get() + offset * destination.request.layout.GetBytes();
    this->WriteTile(tile, destination.request, first, strides);
  }
}

void
PieceEngine::WriteTile(const itk::MedialVoxelTileResult & tile,
                       const VolumeRequest &              request,
                       void *                             first,
                       const itk::MedialVoxelStrides &    strides) const
{
  request.write(tile, { first, strides, m_Geometry, m_Grid.GetSpacing() });
}

void
PieceEngine::UpdateProgress(float fraction)
{
  m_IsStopped = m_Observer(fraction) || m_IsStopped;
}

itk::MedialVoxelBox
PieceEngine::GetRegion(const PieceRange & range) const
{
  const unsigned int  last = m_Geometry.GetDimension() - 1;
  itk::MedialVoxelBox region = m_Grid.GetVoxelBox();
  region.lower[last] = static_cast<std::int64_t>(range.slices.begin);
  region.upper[last] = static_cast<std::int64_t>(range.slices.end);
  if (range.rows)
  {
    region.lower[1] = static_cast<std::int64_t>(range.rows->begin);
    region.upper[1] = static_cast<std::int64_t>(range.rows->end);
  }
  return region;
}

} // end namespace medialvoxel
