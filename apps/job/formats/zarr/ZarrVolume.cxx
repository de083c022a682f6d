// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrVolume.h"

#include "FileNames.h"
#include "JsonFile.h"
#include "OutputFile.h"
#include "ZarrPyramid.h"
#include "Text.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MaximumMetadataSize = std::uint64_t{ 1 } << 22;

/** The name without its extensions. */
std::string
GetImageName(const std::filesystem::path & folder)
{
  const std::filesystem::path stem = folder.stem();
  return (ToLower(stem.extension().string()) == ".ome" ? stem.stem() : stem).string();
}

} // namespace

ZarrVolume::ZarrVolume(const std::filesystem::path & name, bool overwrite, bool sparse, ZarrCompression compression)
  : m_Folder(name, overwrite)
  , m_Sparse(sparse)
  , m_Compression(compression)
{
  const ZarrCodec * const codec = GetZarrCodec(compression);
  if (codec != nullptr && codec->pack == nullptr)
  {
    Fail(ExitStatus::Usage, name.string(), ": this program was built without ", codec->neededLibrary);
  }
}

std::uint64_t
ZarrVolume::GetMemory(const VolumeGeometry & geometry, const VoxelLayout & layout, ZarrCompression compression)
{
  const ZarrGrid      grid = ZarrGrid::ForVolume(geometry, layout);
  const std::uint64_t chunk = grid.GetChunkSize();
  return 2 * chunk + ZarrChunkWriter::GetMemory(compression, chunk) +
         ZarrChunks::GetBufferMemory(MakeZarrArray(grid, compression));
}

std::uint64_t
ZarrVolume::GetSizeOfSmallerLevels(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  const std::vector<ZarrLevel> levels = MakeZarrLevels(geometry, layout);
  return std::accumulate(
    levels.begin() + 1, levels.end(), std::uint64_t{ 0 }, [](std::uint64_t sum, const auto & level) {
      return sum + level.grid.GetNumberOfAllChunks() * level.grid.GetChunkSize();
    });
}

void
ZarrVolume::Describe(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & process)
{
  m_Levels = MakeZarrLevels(geometry, layout);
  m_Grid = m_Levels.front().grid;
  m_Writer.emplace(m_Compression, m_Grid.GetChunkSize(), GetTraits(layout.pixelType).bytes, process);
  m_Layers.emplace(m_Grid, m_Sparse, *m_Writer, m_Reserve, [this](std::uint64_t component, const ZarrIndex & index) {
    return this->GetChunkFile(component, index);
  });
  const std::string name = GetImageName(m_Folder.GetName());
  m_Metadata = { { ".zgroup", MakeZarrGroupText() }, { ".zattrs", MakeZarrAttributesText(name, m_Levels) } };
  for (const ZarrLevel & level : m_Levels)
  {
    m_Metadata.push_back(
      { std::filesystem::path(level.folder) / ZarrArrayFile, MakeZarrArrayText(level.grid, m_Compression) });
  }
}

void
ZarrVolume::WriteMetadata() const
{
  for (const ZarrLevel & level : m_Levels)
  {
    const std::filesystem::path array = m_Folder.GetPath() / level.folder;
    std::error_code             error;
    std::filesystem::create_directory(array, error);
    if (error)
    {
      Fail(ExitStatus::Refused, "cannot create the folder ", array.string(), ": ", error.message());
    }
  }
  for (const MetadataFile & file : m_Metadata)
  {
    WriteTextFile(m_Folder.GetPath() / file.name, file.text, false);
  }
}

void
ZarrVolume::CheckMetadata() const
{
  for (const MetadataFile & file : m_Metadata)
  {
    const std::filesystem::path fileName = m_Folder.GetPath() / file.name;
    std::error_code             error;
    if (!std::filesystem::exists(fileName, error) || ReadTextFile(fileName, MaximumMetadataSize) != file.text)
    {
      Fail(ExitStatus::Failure, fileName.string(), " is gone or was changed while the volume was written");
    }
  }
}

void
ZarrVolume::Create(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  this->Describe(geometry, layout);
  m_Folder.Create();
  this->WriteMetadata();
  if (!m_Sparse && m_Compression == ZarrCompression::None)
  {
    m_Reserve.emplace(m_Folder.GetPath() / ".reserve",
                      m_Grid.GetNumberOfAllChunks() * m_Grid.GetChunkSize() + GetSizeOfSmallerLevels(geometry, layout));
  }
}

void
ZarrVolume::CreateShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix)
{
  this->Describe(geometry, layout);
  m_Folder.CreateShared(suffix);
  this->WriteMetadata();
  m_Folder.Finish();
}

void
ZarrVolume::RemoveShared(const std::string & suffix) const
{
  m_Folder.RemoveShared(suffix);
}

void
ZarrVolume::OpenShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix)
{
  this->Describe(geometry, layout, MakeUniqueDigits());
  m_Folder.OpenShared(suffix);
  this->CheckMetadata();
}

void
ZarrVolume::OpenToPublish(const VolumeGeometry & geometry,
                          const VoxelLayout &    layout,
                          const std::string &    suffix,
                          const Publication &    publication)
{
  this->Describe(geometry, layout);
  m_Folder.OpenToPublish(suffix, publication.hasBegun);
  this->CheckMetadata();
  this->RemovePartialChunks();
}

/** Folders of processes that ended early. */
void
ZarrVolume::RemovePartialChunks() const
{
  std::vector<std::filesystem::path> files;
  // Not in the folder of the image, whose own mark has this extension too.
  for (const ZarrLevel & level : m_Levels)
  {
    for (const auto & entry : std::filesystem::recursive_directory_iterator(m_Folder.GetPath() / level.folder))
    {
      itk::MedialVoxelCheckAbort();
      if (entry.path().extension() == PartialExtension)
      {
        files.push_back(entry.path());
      }
    }
  }
  for (const std::filesystem::path & file : files)
  {
    std::filesystem::remove(file);
  }
}

void
ZarrVolume::StartCluster()
{
  m_Layers->StartCluster();
  m_Writer->StartChecksum();
}

std::uint32_t
ZarrVolume::GetChecksum() const
{
  return m_Writer->GetChecksum();
}

/** A chunk that is gone adds nothing, as if it had no bytes. */
std::uint32_t
ZarrVolume::ReadChecksum(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const
{
  const SliceRange slices = this->ToSlices(firstVoxel, numberOfVoxels);
  Checksum         checksum;
  for (std::uint64_t layer = slices.begin / m_Grid.chunk[2]; layer * m_Grid.chunk[2] < slices.end; ++layer)
  {
    this->ForEachChunkOfLayer(layer, [&](std::uint64_t component, const ZarrIndex & index) {
      AddZarrChunk(this->GetChunkFile(component, index), checksum);
    });
  }
  return checksum.GetValue();
}

void
ZarrVolume::Sync()
{
  const std::filesystem::path     top = m_Folder.GetPath();
  std::set<std::filesystem::path> folders;
  for (const std::uint64_t layer : m_Layers->GetLayersOfCluster())
  {
    this->ForEachChunkOfLayer(layer, [&](std::uint64_t component, const ZarrIndex & index) {
      const std::filesystem::path chunkFile = this->GetChunkFile(component, index);
      SyncFile(chunkFile);
      for (auto folder = chunkFile.parent_path(); folder != top && folders.insert(folder).second;)
      {
        folder = folder.parent_path();
      }
    });
  }
  std::for_each(folders.begin(), folders.end(), SyncFolder);
}

void
ZarrVolume::Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data)
{
  this->WriteRows(this->ToSlices(firstVoxel, numberOfVoxels), { 0, m_Grid.size[1] }, data);
}

void
ZarrVolume::WriteRows(const SliceRange & slices, const RowRange & rows, const void * data)
{
  m_Layers->Write(slices, rows, static_cast<const char *>(data));
}

SliceRange
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
  return m_Folder.GetPath() / m_Levels.front().folder / m_Grid.GetChunkName(component, index);
}

/** Calls function(component, index). */
template <typename TFunction>
void
ZarrVolume::ForEachChunkOfLayer(std::uint64_t layer, TFunction && function) const
{
  ForEachChunk(m_Grid,
               { { 0, 0, layer * m_Grid.chunk[2] }, { m_Grid.size[0], m_Grid.size[1], 1 } },
               [&](std::uint64_t component, const ZarrIndex & index) {
                 itk::MedialVoxelCheckAbort();
                 function(component, index);
               });
}

void
ZarrVolume::Finish()
{
  m_Layers->Complete();
  m_Reserve.reset();
  this->CheckChunkFiles(m_Levels.front().folder,
                        m_Sparse ? m_Layers->GetNumberOfChunkFiles() : m_Grid.GetNumberOfAllChunks());
  this->WriteSmallerLevels();
  m_Folder.Finish();
}

/** Replaces the files of an interrupted process by equal ones. */
void
ZarrVolume::WriteSmallerLevels()
{
  ZarrPyramid pyramid(m_Folder.GetPath(), m_Compression, *m_Writer);
  for (std::size_t level = 1; level < m_Levels.size(); ++level)
  {
    const std::uint64_t numberOfFiles = pyramid.Write(m_Levels[level - 1], m_Levels[level]);
    this->CheckChunkFiles(m_Levels[level].folder, numberOfFiles);
  }
}

/** All chunks are there and, when they are not packed, have their size. */
void
ZarrVolume::CheckChunkFiles(const std::string & level, std::uint64_t expected) const
{
  const std::filesystem::path array = m_Folder.GetPath() / level;
  std::uint64_t               files = 0;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(array))
  {
    itk::MedialVoxelCheckAbort();
    if (entry.is_directory() || entry.path().filename() == ZarrArrayFile)
    {
      continue;
    }
    ++files;
    if (m_Compression == ZarrCompression::None && entry.file_size() != m_Grid.GetChunkSize())
    {
      Fail(ExitStatus::Failure,
           entry.path().string(),
           " has ",
           entry.file_size(),
           " bytes after writing, not ",
           m_Grid.GetChunkSize());
    }
  }
  if (files != expected)
  {
    Fail(ExitStatus::Failure, array.string(), " has ", files, " chunks after writing, not ", expected);
  }
}

void
ZarrVolume::Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const
{
  const SliceRange slices = this->ToSlices(firstVoxel, numberOfVoxels);
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
  if (!m_Reader)
  {
    auto chunks = std::make_unique<ZarrChunks>(
      m_Folder.GetPath() / m_Levels.front().folder, MakeZarrArray(m_Grid, m_Compression), 0);
    auto buffers = chunks->MakeBuffers();
    m_Reader = Reader{ std::move(chunks), std::move(buffers) };
  }
  const auto readChunk = [&](std::uint64_t component, const ZarrIndex & index) {
    itk::MedialVoxelCheckAbort();
    const ZarrBox       chunkBox = m_Grid.GetBox(index);
    const ZarrBox       part = Intersect(chunkBox, box);
    const char * const  chunk = m_Reader->chunks->Read(component, index, m_Reader->buffers);
    std::vector<char> & zeros = m_Layers->GetBuffer();
    if (chunk == nullptr)
    {
      std::fill(zeros.begin(), zeros.end(), '\0');
    }
    const char * const planes =
      (chunk != nullptr ? chunk : zeros.data()) + (part.begin[2] - chunkBox.begin[2]) * m_Grid.GetPlaneSize();
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
    Fail(ExitStatus::Refused, m_Folder.GetName().string(), " was created during the run and is not a Zarr folder");
  }
  m_Folder.Publish();
}

} // end namespace medialvoxel
