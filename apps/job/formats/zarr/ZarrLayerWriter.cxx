// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrLayerWriter.h"

#include "Zeros.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{

ZarrLayerWriter::ZarrLayerWriter(const ZarrGrid &              grid,
                                 bool                          sparse,
                                 ZarrChunkWriter &             writer,
                                 std::optional<SpaceReserve> & reserve,
                                 ChunkFileFunction             chunkFile)
  : m_Grid(grid)
  , m_Sparse(sparse)
  , m_Writer(writer)
  , m_Reserve(reserve)
  , m_ChunkFile(std::move(chunkFile))
  , m_Chunk(grid.GetChunkSize())
{}

void
ZarrLayerWriter::Write(const SliceRange & slices, const RowRange & rows, const char * voxels)
{
  const std::uint64_t sliceSize = m_Grid.size[0] * (rows.end - rows.begin) * m_Grid.layout.GetBytes();
  for (std::uint64_t begin = slices.begin; begin < slices.end;)
  {
    const std::uint64_t layer = begin / m_Grid.chunk[2];
    const ZarrBox       box = m_Grid.GetBox({ 0, 0, layer });
    const std::uint64_t endOfLayer = box.begin[2] + box.size[2];
    const std::uint64_t end = std::min(slices.end, endOfLayer);
    States &            states = m_OpenLayers[layer];
    states.resize(m_Grid.GetChunksPerLayer(), State::Missing);
    if (end - begin == box.size[2])
    {
      this->WriteChunks(layer, rows, voxels);
    }
    else
    {
      this->WriteSpans(layer, { begin, end }, rows, voxels);
    }
    if (end == endOfLayer && rows.end == m_Grid.size[1])
    {
      this->CompleteLayer(layer);
      m_OpenLayers.erase(layer);
    }
    voxels += (end - begin) * sliceSize;
    begin = end;
  }
}

void
ZarrLayerWriter::Complete()
{
  for (const auto & open : m_OpenLayers)
  {
    this->CompleteLayer(open.first);
  }
  m_OpenLayers.clear();
}

/** Chunks of which no part came have zeros only. */
void
ZarrLayerWriter::CompleteLayer(std::uint64_t layer)
{
  const auto complete = [this](std::uint64_t component, const ZarrIndex & index, State & state) {
    if (state == State::HasSpans)
    {
      m_Writer.CompleteSpans(m_ChunkFile(component, index), m_Chunk.data());
      ++m_ChunkFiles;
    }
    else if (state == State::Missing && !m_Sparse)
    {
      std::fill(m_Chunk.begin(), m_Chunk.end(), '\0');
      this->WriteChunk(m_ChunkFile(component, index));
    }
  };
  this->ForEachChunk(layer, { 0, m_Grid.size[1] }, complete);
  m_LayersOfCluster.push_back(layer);
}

void
ZarrLayerWriter::StartCluster()
{
  m_OpenLayers.clear();
  m_LayersOfCluster.clear();
}

/** Calls function(component, index, state) for the chunks of an open layer. */
template <typename TFunction>
void
ZarrLayerWriter::ForEachChunk(std::uint64_t layer, const RowRange & rows, TFunction && function)
{
  States &      states = m_OpenLayers.at(layer);
  const ZarrBox box{ { 0, rows.begin, layer * m_Grid.chunk[2] }, { m_Grid.size[0], rows.end - rows.begin, 1 } };
  medialvoxel::ForEachChunk(m_Grid, box, [&](std::uint64_t component, const ZarrIndex & index) {
    itk::MedialVoxelCheckAbort();
    const std::uint64_t row = component * m_Grid.GetNumberOfChunks(1) + index[1];
    function(component, index, states[row * m_Grid.GetNumberOfChunks(0) + index[0]]);
  });
}

void
ZarrLayerWriter::WriteChunks(std::uint64_t layer, const RowRange & rows, const char * voxels)
{
  const std::uint64_t slices = m_Grid.GetBox({ 0, 0, layer }).size[2];
  const std::uint64_t bytes = slices * m_Grid.GetPlaneSize();
  this->ForEachChunk(layer, rows, [&](std::uint64_t component, const ZarrIndex & index, State & state) {
    state = State::Complete;
    GatherSlices(m_Grid, component, index[0], index[1], slices, rows, voxels, m_Chunk.data());
    if (m_Sparse && IsAllZero(m_Chunk.data(), bytes))
    {
      return;
    }
    std::fill(m_Chunk.begin() + static_cast<std::ptrdiff_t>(bytes), m_Chunk.end(), '\0');
    this->WriteChunk(m_ChunkFile(component, index));
  });
}

void
ZarrLayerWriter::WriteSpans(std::uint64_t layer, const SliceRange & slices, const RowRange & rows, const char * voxels)
{
  const std::uint64_t planeSize = m_Grid.GetPlaneSize();
  const std::uint64_t count = slices.end - slices.begin;
  const std::uint64_t bytes = count * planeSize;
  const std::uint64_t offset = (slices.begin - layer * m_Grid.chunk[2]) * planeSize;
  this->ForEachChunk(layer, rows, [&](std::uint64_t component, const ZarrIndex & index, State & state) {
    GatherSlices(m_Grid, component, index[0], index[1], count, rows, voxels, m_Chunk.data());
    if (!IsAllZero(m_Chunk.data(), bytes))
    {
      const bool isFirst = state == State::Missing;
      this->GiveSpaceBack(isFirst ? m_Chunk.size() : 0);
      m_Writer.WriteSpan(m_ChunkFile(component, index), { offset, bytes, m_Chunk.size() }, m_Chunk.data(), isFirst);
      state = State::HasSpans;
    }
  });
}

void
ZarrLayerWriter::WriteChunk(const std::filesystem::path & chunkFile)
{
  this->GiveSpaceBack(m_Chunk.size());
  m_Writer.Write(chunkFile, m_Chunk.data());
  ++m_ChunkFiles;
}

void
ZarrLayerWriter::GiveSpaceBack(std::uint64_t numberOfBytes)
{
  if (m_Reserve)
  {
    m_Reserve->GiveBack(numberOfBytes);
  }
}

} // end namespace medialvoxel
