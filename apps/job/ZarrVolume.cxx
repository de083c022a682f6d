// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrVolume.h"

#include "FileTransfer.h"
#include "OutputFile.h"
#include "Text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

bool
IsAllZero(const char * data, std::uint64_t numberOfBytes)
{
  // Every byte equals its successor and the first one is zero: one call that runs at the speed of memory.
  return data[0] == 0 && std::memcmp(data, data + 1, numberOfBytes - 1) == 0;
}

void
WriteTextFile(const std::filesystem::path & fileName, const std::string & text)
{
  OutputFile file(fileName, false);
  file.Create(0, false);
  WriteText(file, text);
  file.Publish();
}

/** The name without its extensions. */
std::string
GetImageName(const std::filesystem::path & folder)
{
  const std::filesystem::path stem = folder.stem();
  return (ToLower(stem.extension().string()) == ".ome" ? stem.stem() : stem).string();
}

} // namespace

SpaceReserve::SpaceReserve(const std::filesystem::path & fileName, std::uint64_t numberOfBytes)
  : m_FileName(fileName)
  , m_NumberOfBytes(numberOfBytes)
  , m_Descriptor(open(fileName.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
{
  if (m_Descriptor < 0 || !ReserveSpace(m_Descriptor, numberOfBytes))
  {
    const int error = errno;
    close(m_Descriptor);
    Fail(ExitStatus::Refused,
         "cannot reserve ",
         numberOfBytes,
         " bytes (",
         FormatBytes(numberOfBytes),
         ") in ",
         fileName.parent_path().string(),
         ": ",
         std::strerror(error));
  }
}

SpaceReserve::~SpaceReserve()
{
  close(m_Descriptor);
  std::error_code error;
  std::filesystem::remove(m_FileName, error);
}

void
SpaceReserve::GiveBack(std::uint64_t numberOfBytes)
{
  m_NumberOfBytes -= std::min(m_NumberOfBytes, numberOfBytes);
  if (ftruncate(m_Descriptor, static_cast<off_t>(m_NumberOfBytes)) != 0)
  {
    Fail(ExitStatus::Failure, "cannot set the size of ", m_FileName.string(), ": ", std::strerror(errno));
  }
}

ZarrVolume::ZarrVolume(const std::filesystem::path & name, bool overwrite, bool sparse, ZarrCompression compression)
  : m_Folder(name, overwrite)
  , m_Sparse(sparse)
  , m_Compression(compression)
{}

std::uint64_t
ZarrVolume::GetMemoryBytes(const VolumeGeometry & geometry, const VoxelLayout & layout, ZarrCompression compression)
{
  const std::uint64_t chunk = ZarrGrid::ForVolume(geometry, layout).GetChunkBytes();
  return chunk + ZarrChunkWriter::GetMemoryBytes(compression, chunk);
}

void
ZarrVolume::Create(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  m_Grid = ZarrGrid::ForVolume(geometry, layout);
  m_Writer.emplace(m_Compression, m_Grid.GetChunkBytes());
  m_Chunk.resize(m_Grid.GetChunkBytes());
  m_Folder.Create();
  const std::filesystem::path & group = m_Folder.GetTemporaryName();
  const std::filesystem::path   array = group / ZarrArrayFolder;
  std::filesystem::create_directory(array);
  WriteTextFile(group / ".zgroup", MakeZarrGroupText());
  WriteTextFile(group / ".zattrs",
                MakeZarrAttributesText(GetImageName(m_Folder.GetName()), geometry, m_Grid.leadingAxes));
  WriteTextFile(array / ".zarray", MakeZarrArrayText(m_Grid, m_Compression));
  if (!m_Sparse && m_Compression == ZarrCompression::None)
  {
    m_Reserve.emplace(group / ".reserve", m_Grid.GetNumberOfAllChunks() * m_Grid.GetChunkBytes());
  }
}

void
ZarrVolume::Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data)
{
  const Slices        slices = this->ToSlices(firstVoxel, numberOfVoxels);
  const std::uint64_t sliceBytes = m_Grid.size[0] * m_Grid.size[1] * m_Grid.layout.GetBytes();
  const auto *        voxels = static_cast<const char *>(data);
  for (std::uint64_t begin = slices.begin; begin < slices.end;)
  {
    const std::uint64_t layer = begin / m_Grid.chunk[2];
    const ZarrBox       box = m_Grid.GetBox({ 0, 0, layer });
    const std::uint64_t end = std::min(slices.end, box.begin[2] + box.size[2]);
    if (m_OpenLayer && m_OpenLayer != layer)
    {
      this->CompleteOpenLayer();
    }
    if (end - begin == box.size[2])
    {
      this->WriteLayer(layer, voxels);
    }
    else
    {
      this->WritePart(layer, { begin, end }, voxels);
    }
    voxels += (end - begin) * sliceBytes;
    begin = end;
  }
}

ZarrVolume::Slices
ZarrVolume::ToSlices(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const
{
  const std::uint64_t perSlice = m_Grid.size[0] * m_Grid.size[1];
  const std::uint64_t end = firstVoxel + numberOfVoxels;
  if (firstVoxel % perSlice != 0 || end % perSlice != 0 || end / perSlice > m_Grid.size[2])
  {
    Fail(ExitStatus::Failure, "voxels ", firstVoxel, " to ", end, " are not whole slices of the volume");
  }
  return { firstVoxel / perSlice, end / perSlice };
}

std::filesystem::path
ZarrVolume::GetChunkFile(std::uint64_t component, const ZarrIndex & index) const
{
  return m_Folder.GetTemporaryName() / ZarrArrayFolder / m_Grid.GetChunkName(component, index);
}

/** Calls function(component, index, number of the chunk in its layer). */
template <typename TFunction>
void
ZarrVolume::ForEachChunkOfLayer(std::uint64_t layer, TFunction && function)
{
  std::uint64_t number = 0;
  ForEachChunk(m_Grid,
               { { 0, 0, layer * m_Grid.chunk[2] }, { m_Grid.size[0], m_Grid.size[1], 1 } },
               [&](std::uint64_t component, const ZarrIndex & index) { function(component, index, number++); });
}

void
ZarrVolume::WriteLayer(std::uint64_t layer, const char * voxels)
{
  const std::uint64_t slices = m_Grid.GetBox({ 0, 0, layer }).size[2];
  const std::uint64_t bytes = slices * m_Grid.GetPlaneBytes();
  this->ForEachChunkOfLayer(layer, [&](std::uint64_t component, const ZarrIndex & index, std::uint64_t) {
    GatherSlices(m_Grid, component, index[0], index[1], slices, voxels, m_Chunk.data());
    if (m_Sparse && IsAllZero(m_Chunk.data(), bytes))
    {
      return;
    }
    std::fill(m_Chunk.begin() + static_cast<std::ptrdiff_t>(bytes), m_Chunk.end(), '\0');
    this->GiveSpaceBack(m_Chunk.size());
    this->WriteChunk(this->GetChunkFile(component, index));
  });
}

void
ZarrVolume::WritePart(std::uint64_t layer, const Slices & slices, const char * voxels)
{
  if (!m_OpenLayer)
  {
    m_OpenLayer = layer;
    m_HasPart.assign(m_Grid.GetChunksPerLayer(), false);
  }
  const std::uint64_t planeBytes = m_Grid.GetPlaneBytes();
  const std::uint64_t bytes = (slices.end - slices.begin) * planeBytes;
  const std::uint64_t offset = (slices.begin - layer * m_Grid.chunk[2]) * planeBytes;
  this->ForEachChunkOfLayer(layer, [&](std::uint64_t component, const ZarrIndex & index, std::uint64_t number) {
    GatherSlices(m_Grid, component, index[0], index[1], slices.end - slices.begin, voxels, m_Chunk.data());
    if (!IsAllZero(m_Chunk.data(), bytes))
    {
      this->GiveSpaceBack(m_HasPart[number] ? 0 : m_Chunk.size());
      m_Writer->WritePart(this->GetChunkFile(component, index), offset, m_Chunk.data(), bytes);
      m_HasPart[number] = true;
    }
  });
  const ZarrBox box = m_Grid.GetBox({ 0, 0, layer });
  if (slices.end == box.begin[2] + box.size[2])
  {
    this->CompleteOpenLayer();
  }
}

/** Chunks of which no part came have zeros only. */
void
ZarrVolume::CompleteOpenLayer()
{
  this->ForEachChunkOfLayer(*m_OpenLayer,
                            [this](std::uint64_t component, const ZarrIndex & index, std::uint64_t number) {
                              const std::filesystem::path chunkFile = this->GetChunkFile(component, index);
                              if (m_HasPart[number])
                              {
                                m_Writer->CompleteParts(chunkFile, m_Chunk.data());
                                ++m_ChunkFiles;
                              }
                              else if (!m_Sparse)
                              {
                                std::fill(m_Chunk.begin(), m_Chunk.end(), '\0');
                                this->GiveSpaceBack(m_Chunk.size());
                                this->WriteChunk(chunkFile);
                              }
                            });
  m_OpenLayer.reset();
}

void
ZarrVolume::WriteChunk(const std::filesystem::path & chunkFile)
{
  m_Writer->Write(chunkFile, m_Chunk.data());
  ++m_ChunkFiles;
}

void
ZarrVolume::GiveSpaceBack(std::uint64_t numberOfBytes)
{
  if (m_Reserve)
  {
    m_Reserve->GiveBack(numberOfBytes);
  }
}

void
ZarrVolume::Finish()
{
  if (m_OpenLayer)
  {
    this->CompleteOpenLayer();
  }
  m_Reserve.reset();
  this->CheckChunkFiles();
  m_Folder.Finish();
}

/** All chunks are there and, when they are not packed, have their size. */
void
ZarrVolume::CheckChunkFiles() const
{
  const std::filesystem::path array = m_Folder.GetTemporaryName() / ZarrArrayFolder;
  std::uint64_t               files = 0;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(array))
  {
    if (entry.is_directory() || entry.path().filename() == ".zarray")
    {
      continue;
    }
    ++files;
    if (m_Compression == ZarrCompression::None && entry.file_size() != m_Chunk.size())
    {
      Fail(ExitStatus::Failure,
           entry.path().string(),
           " has ",
           entry.file_size(),
           " bytes after writing, not ",
           m_Chunk.size());
    }
  }
  const std::uint64_t expected = m_Sparse ? m_ChunkFiles : m_Grid.GetNumberOfAllChunks();
  if (files != expected)
  {
    Fail(ExitStatus::Failure, array.string(), " has ", files, " chunks after writing, not ", expected);
  }
}

void
ZarrVolume::Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const
{
  const Slices slices = this->ToSlices(firstVoxel, numberOfVoxels);
  this->ReadBox({ { 0, 0, slices.begin }, { m_Grid.size[0], m_Grid.size[1], slices.end - slices.begin } }, data);
}

bool
ZarrVolume::ReadPlane(unsigned int axis, std::uint64_t index, void * data) const
{
  ZarrBox box{ { 0, 0, 0 }, m_Grid.size };
  if (m_Grid.dimension == 3)
  {
    box.begin[axis] = index;
    box.size[axis] = 1;
  }
  this->ReadBox(box, data);
  return true;
}

void
ZarrVolume::ReadBox(const ZarrBox & box, void * data) const
{
  const auto readChunk = [&](std::uint64_t component, const ZarrIndex & index) {
    const ZarrBox chunkBox = m_Grid.GetBox(index);
    const ZarrBox part = Intersect(chunkBox, box);
    if (!ReadZarrChunk(this->GetChunkFile(component, index), m_Compression, m_Chunk.data(), m_Chunk.size()))
    {
      std::fill(m_Chunk.begin(), m_Chunk.end(), '\0');
    }
    const char * const planes = m_Chunk.data() + (part.begin[2] - chunkBox.begin[2]) * m_Grid.GetPlaneBytes();
    ScatterSlices(m_Grid, component, index, part, planes, box, data);
  };
  ForEachChunk(m_Grid, box, readChunk);
}

void
ZarrVolume::Publish()
{
  std::error_code error;
  if (std::filesystem::exists(m_Folder.GetName(), error) && !IsZarrFolder(m_Folder.GetName()))
  {
    Fail(ExitStatus::Refused, m_Folder.GetName().string(), " has come up meanwhile and is not a Zarr folder");
  }
  m_Folder.Publish();
}

} // end namespace medialvoxel
