// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrStream.h"

#include "PartStream.h"
#include "ZarrChunkFile.h"

namespace medialvoxel
{
namespace
{

/** \class ZarrStream
 * \brief Reads one layer of chunks after the other, as voxels of the volume. */
class ZarrStream : public PartStream
{
public:
  explicit ZarrStream(const VolumeHeader & header)
    : m_Folder(header.dataFile.parent_path())
    , m_Array(ReadZarrArray(header.dataFile, header.geometry.GetDimension()))
    , m_Chunk(m_Array.grid.GetChunkBytes())
  {}

private:
  std::uint64_t
  ReadPart(std::vector<char> & voxels) override
  {
    const ZarrGrid & grid = m_Array.grid;
    ZarrBox          box = grid.GetBox({ 0, 0, m_NextLayer++ });
    box.size[0] = grid.size[0];
    box.size[1] = grid.size[1];
    std::uint64_t bytesRead = 0;
    voxels.resize(box.size[0] * box.size[1] * box.size[2] * GetTraits(grid.layout.pixelType).bytes);
    ForEachChunk(grid, box, [&](std::uint64_t, const ZarrIndex & index) {
      const std::filesystem::path chunkFile = m_Folder / grid.GetChunkName(0, index);
      if (ReadZarrChunk(chunkFile, m_Array.compression, m_Chunk.data(), m_Chunk.size()))
      {
        bytesRead += std::filesystem::file_size(chunkFile);
      }
      else
      {
        FillChunk(m_Array, m_Chunk);
        SwapToMachineOrder(m_Array, m_Chunk); // back, as the reader of the stream swaps
      }
      ScatterSlices(grid, 0, index, grid.GetBox(index), m_Chunk.data(), box, voxels.data());
    });
    return bytesRead;
  }

  std::filesystem::path m_Folder;
  ZarrArray             m_Array;
  std::vector<char>     m_Chunk;
  std::uint64_t         m_NextLayer{ 0 };
};

} // namespace

std::unique_ptr<VoxelStream>
OpenZarrStream(const VolumeHeader & header)
{
  return std::make_unique<ZarrStream>(header);
}

} // end namespace medialvoxel
