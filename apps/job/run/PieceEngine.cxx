// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceEngine.h"

#include <utility>
#include <variant>

namespace medialvoxel
{

itk::MedialVoxelEngineSettings
MakeEngineSettings(const VolumeHeader & header, const itk::MedialVoxelEngineTask & task)
{
  const bool isReal = header.pixelType == PixelType::Float32 || header.pixelType == PixelType::Float64;
  itk::MedialVoxelEngineSettings settings;
  settings.task = task;
  // A mask has counted them.
  settings.countsNotANumber = isReal && header.CanStream();
  return settings;
}

void
PieceEngine::Buffer::Reserve(std::uint64_t bytes)
{
  if (m_Size < bytes)
  {
    // First, or there would be two of them.
    this->Release();
    // Not set to zero: tiles write every voxel.
    m_Bytes.reset(new std::byte[bytes]);
    m_Size = bytes;
  }
}

void
PieceEngine::Buffer::Release()
{
  m_Bytes.reset();
  m_Size = 0;
}

PieceEngine::PieceEngine(InputVolume &                      input,
                         const VolumeHeader &               header,
                         const JobOptions &                 options,
                         const JobPlan &                    plan,
                         const itk::MedialVoxelEngineTask & task,
                         const PieceObserver &              observer)
  : m_Input(input)
  , m_Geometry(header.geometry)
  , m_UsesVoxelUnits(options.voxelUnits)
  , m_Grid(GetGrid(options, header))
  , m_Settings(MakeEngineSettings(header, task))
  , m_Observer(observer)
{
  m_Settings.slabThickness = static_cast<std::int64_t>(plan.slabThickness);
  m_Settings.memoryLimit = plan.GetFilterLimit(plan.GetMaximumSlices());
  m_Settings.numberOfWorkers = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
}

const char *
PieceEngine::GetName() const
{
  return std::holds_alternative<itk::MedialVoxelExtraction>(m_Settings.task) ? "labels" : "distances";
}

void
PieceEngine::Request(VolumeContent content, const VoxelLayout & layout)
{
  m_Results[static_cast<std::size_t>(content)].bytesPerVoxel = layout.GetBytes();
}

void
PieceEngine::AddObserver(itk::MedialVoxelTileObserver & observer)
{
  std::get<itk::MedialVoxelExtraction>(m_Settings.task).AddObserver(observer);
}

void
PieceEngine::SetMemoryLimit(std::uint64_t bytes)
{
  m_Settings.memoryLimit = bytes;
  m_Engine.reset();
}

PieceResults
PieceEngine::Run(std::uint64_t firstSlice, std::uint64_t numberOfSlices)
{
  m_Region = this->GetRegion(firstSlice, numberOfSlices);
  PieceResults results;
  for (std::size_t content = 0; content < m_Results.size(); ++content)
  {
    Buffer & buffer = m_Results[content].buffers[m_Set];
    buffer.Reserve(static_cast<std::uint64_t>(m_Region.NumberOfVoxels()) * m_Results[content].bytesPerVoxel);
    results.voxels[content] = buffer.Get();
  }
  if (!m_Engine)
  {
    m_Engine = std::make_unique<itk::MedialVoxelEngine>(m_Grid, m_Settings);
  }
  try
  {
    results.sums = m_Engine->Run(m_Region, *this);
  }
  catch (...)
  {
    m_Engine.reset();
    throw;
  }
  if (m_Engine->IsLast(m_Region))
  {
    // Nobody needs the window.
    m_Engine.reset();
  }
  // Not before: the results of the piece before may be in use when this one is tried again.
  m_Set = (m_Set + 1) % m_NumberOfSets;
  return results;
}

void
PieceEngine::Release()
{
  for (Result & result : m_Results)
  {
    for (Buffer & buffer : result.buffers)
    {
      buffer.Release();
    }
  }
}

void
PieceEngine::FillObject(const itk::MedialVoxelBox & box,
                        itk::MedialVoxelBits &      object,
                        itk::MedialVoxelBits *      notANumber)
{
  m_Input.Fill(box, { &object, notANumber, nullptr });
}

void
PieceEngine::FillObjectAndGray(const itk::MedialVoxelBox & box,
                               itk::MedialVoxelBits &      object,
                               itk::MedialVoxelBits *      notANumber,
                               itk::MedialVoxelGray &      gray)
{
  m_Input.Fill(box, { &object, notANumber, &gray });
}

void
PieceEngine::FillGray(const itk::MedialVoxelBox & box, itk::MedialVoxelGray & gray)
{
  m_Input.Fill(box, { nullptr, nullptr, &gray });
}

void
PieceEngine::RunWorkers(unsigned int numberOfWorkers, const std::function<void()> & work)
{
  m_Threader->SetNumberOfWorkUnits(static_cast<itk::ThreadIdType>(numberOfWorkers));
  m_Threader->ParallelizeArray(0, numberOfWorkers, [&work](itk::SizeValueType) { work(); }, nullptr);
}

void
PieceEngine::RunTile(const itk::MedialVoxelBox & tile)
{
  m_Engine->ProcessTile(tile);
}

void
PieceEngine::TakeTile(const itk::MedialVoxelTileResult & tile)
{
  const itk::MedialVoxelIndex & first = tile.box.lower;
  const itk::MedialVoxelStrides strides = this->GetStrides();
  if (auto * const labels = this->FindResult<std::uint8_t>(VolumeContent::Labels, first))
  {
    tile.WriteLabels(labels, strides);
  }
  if (auto * const thicknesses = this->FindResult<float>(VolumeContent::Thicknesses, first))
  {
    tile.WriteThickness(thicknesses, strides);
  }
  if (auto * const distances = this->FindResult<float>(VolumeContent::Distances, first))
  {
    tile.WriteDistances({ m_Grid.GetSpacing() }, distances, strides);
  }
  if (auto * const vectors = this->FindResult<float>(VolumeContent::Vectors, first))
  {
    m_Geometry.GetDimension() == 2 ? this->WriteVectors<2>(tile, vectors) : this->WriteVectors<3>(tile, vectors);
  }
}

template <unsigned int VDimension>
void
PieceEngine::WriteVectors(const itk::MedialVoxelTileResult & tile, float * first) const
{
  using WriterType = itk::MedialVoxelDisplacementWriter<VDimension, float>;
  typename WriterType::MatrixType matrix{};
  for (unsigned int row = 0; row < VDimension; ++row)
  {
    for (unsigned int axis = 0; axis < VDimension; ++axis)
    {
      const double unit = row == axis ? 1.0 : 0.0;
      matrix[row][axis] = m_UsesVoxelUnits ? unit : m_Geometry.direction[axis][row] * m_Geometry.spacing[axis];
    }
  }
  tile.WriteVectors(WriterType(matrix), first, this->GetStrides());
}

void
PieceEngine::UpdateProgress(float fraction)
{
  m_IsStopped = m_Observer(fraction) || m_IsStopped;
}

itk::MedialVoxelBox
PieceEngine::GetRegion(std::uint64_t firstSlice, std::uint64_t numberOfSlices) const
{
  const unsigned int  last = m_Geometry.GetDimension() - 1;
  itk::MedialVoxelBox region = m_Grid.GetVoxelBox();
  region.lower[last] = static_cast<std::int64_t>(firstSlice);
  region.upper[last] = static_cast<std::int64_t>(firstSlice + numberOfSlices);
  return region;
}

itk::MedialVoxelStrides
PieceEngine::GetStrides() const
{
  return { 1, m_Region.Extent(0), m_Region.Extent(0) * m_Region.Extent(1) };
}

template <typename TValue>
TValue *
PieceEngine::FindResult(VolumeContent content, const itk::MedialVoxelIndex & voxel)
{
  const Result & result = m_Results[static_cast<std::size_t>(content)];
  if (result.bytesPerVoxel == 0)
  {
    return nullptr;
  }
  std::byte * const bytes = result.buffers[m_Set].Get() + m_Region.OffsetOf(voxel) * result.bytesPerVoxel;
  return reinterpret_cast<TValue *>(bytes);
}

} // end namespace medialvoxel
