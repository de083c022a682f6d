// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrImageIO.h"

#include "ZarrChunkFile.h"

#include "itkByteSwapper.h"

#include <utility>

namespace medialvoxel
{
namespace
{

/** \class ZarrImageIO
 * \brief What MakeZarrImageIO() makes. */
class ZarrImageIO : public itk::StreamingRawImageIO
{
public:
  using Self = ZarrImageIO;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  void
  SetArray(const std::filesystem::path & folder, ZarrArray array)
  {
    m_Folder = folder;
    m_Array = std::move(array);
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

  /** Chunks are checked when they are read. */
  void
  ReadImageInformation() override
  {}

  void
  Read(void * buffer) override
  {
    const ZarrBox box = this->GetRequestedBox();
    ForEachChunk(
      m_Array.grid, box, [&](std::uint64_t, const ZarrIndex & index) { this->ReadChunk(index, box, buffer); });
  }

private:
  ZarrBox
  GetRequestedBox() const
  {
    const itk::ImageIORegion & region = this->GetIORegion();
    ZarrBox                    box{ { 0, 0, 0 }, { 1, 1, 1 } };
    for (unsigned int axis = 0; axis < m_Array.grid.dimension; ++axis)
    {
      const unsigned int place = m_Array.grid.dimension == 2 && axis == 1 ? 2 : axis;
      box.begin[place] = static_cast<std::uint64_t>(region.GetIndex(axis));
      box.size[place] = region.GetSize(axis);
    }
    return box;
  }

  void
  ReadChunk(const ZarrIndex & index, const ZarrBox & box, void * buffer)
  {
    const ZarrGrid &    grid = m_Array.grid;
    const ZarrBox       chunkBox = grid.GetBox(index);
    const ZarrBox       part = Intersect(chunkBox, box);
    const std::uint64_t planeBytes = grid.GetPlaneBytes();
    const std::uint64_t firstPlane = part.begin[2] - chunkBox.begin[2];
    m_Planes.resize(part.size[2] * planeBytes);
    const ZarrChunkPart bytes{ firstPlane * planeBytes, m_Planes.size(), grid.GetChunkBytes() };
    if (ReadZarrChunkPart(m_Folder / grid.GetChunkName(0, index), bytes, m_Planes.data()))
    {
      m_BytesRead += m_Planes.size();
      SwapToMachineOrder(m_Array, m_Planes);
    }
    else
    {
      FillChunk(m_Array, m_Planes);
    }
    ScatterSlices(grid, 0, index, part, m_Planes.data(), box, buffer);
  }

  std::filesystem::path m_Folder;
  ZarrArray             m_Array;
  std::vector<char>     m_Planes; ///< of one chunk
  std::uint64_t         m_BytesRead{ 0 };
};

} // namespace

itk::StreamingRawImageIO::Pointer
MakeZarrImageIO(const VolumeHeader & header)
{
  const auto imageIO = ZarrImageIO::New();
  imageIO->SetArray(header.dataFile.parent_path(), ReadZarrArray(header.dataFile, header.geometry.GetDimension()));
  return imageIO.GetPointer();
}

} // end namespace medialvoxel
