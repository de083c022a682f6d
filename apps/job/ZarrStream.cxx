// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrStream.h"

#include "ZarrChunkFile.h"

#include <algorithm>
#include <cstring>

namespace medialvoxel
{
namespace
{

/** \class ZarrStream
 * \brief Keeps one layer of chunks, as voxels of the volume. */
class ZarrStream : public VoxelStream
{
public:
  explicit ZarrStream(const VolumeHeader & header)
    : m_Folder(header.dataFile.parent_path())
    , m_Array(ReadZarrArray(header.dataFile, header.geometry.GetDimension()))
    , m_Chunk(m_Array.grid.GetChunkBytes())
  {}

  void
  Read(void * destination, std::uint64_t numberOfBytes) override
  {
    auto * bytes = static_cast<char *>(destination);
    while (numberOfBytes > 0)
    {
      if (m_Position == m_Layer.size())
      {
        this->ReadLayer();
      }
      const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, m_Layer.size() - m_Position);
      std::memcpy(bytes, m_Layer.data() + m_Position, count);
      m_Position += count;
      bytes += count;
      numberOfBytes -= count;
    }
  }

  /** Each chunk was checked to its end. */
  void
  CheckEnd() override
  {}

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

private:
  void
  ReadLayer()
  {
    const ZarrGrid & grid = m_Array.grid;
    ZarrBox          box = grid.GetBox({ 0, 0, m_NextLayer++ });
    box.size[0] = grid.size[0];
    box.size[1] = grid.size[1];
    m_Layer.resize(box.size[0] * box.size[1] * box.size[2] * GetTraits(grid.layout.pixelType).bytes);
    m_Position = 0;
    ForEachChunk(grid, box, [&](std::uint64_t, const ZarrIndex & index) {
      const std::filesystem::path chunkFile = m_Folder / grid.GetChunkName(0, index);
      if (ReadZarrChunk(chunkFile, m_Array.compression, m_Chunk.data(), m_Chunk.size()))
      {
        m_BytesRead += std::filesystem::file_size(chunkFile);
      }
      else
      {
        FillChunk(m_Array, m_Chunk);
        SwapToMachineOrder(m_Array, m_Chunk); // back, as the reader of the stream swaps
      }
      ScatterSlices(grid, 0, index, grid.GetBox(index), m_Chunk.data(), box, m_Layer.data());
    });
  }

  std::filesystem::path m_Folder;
  ZarrArray             m_Array;
  std::vector<char>     m_Chunk;
  std::vector<char>     m_Layer;
  std::uint64_t         m_Position{ 0 }; ///< in the layer
  std::uint64_t         m_NextLayer{ 0 };
  std::uint64_t         m_BytesRead{ 0 };
};

} // namespace

std::unique_ptr<VoxelStream>
OpenZarrStream(const VolumeHeader & header)
{
  return std::make_unique<ZarrStream>(header);
}

} // end namespace medialvoxel
