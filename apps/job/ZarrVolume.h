// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrVolume_h
#define medialvoxelZarrVolume_h

#include "OutputFolder.h"
#include "VoxelOutput.h"
#include "ZarrChunkFile.h"

#include <memory>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class SpaceReserve
 * \brief A file that keeps space on the disk for others, and gives it back as they are written. */
class SpaceReserve
{
public:
  /** \throw JobError Refused when the disk has no space. */
  SpaceReserve(const std::filesystem::path & fileName, std::uint64_t numberOfBytes);

  /** Removes the file. */
  ~SpaceReserve();

  SpaceReserve(const SpaceReserve &) = delete;
  SpaceReserve &
  operator=(const SpaceReserve &) = delete;

  void
  GiveBack(std::uint64_t numberOfBytes);

private:
  std::filesystem::path m_FileName;
  std::uint64_t         m_NumberOfBytes;
  int                   m_Descriptor;
};

/** \class ZarrVolume
 * \brief A folder with a volume as OME-Zarr 0.4: an array of Zarr's version 2, its chunks in files.
 *
 * Slices come in any division. Those that do not fill a layer of chunks wait in the files of their chunks, so that the
 * memory is that of one chunk. */
class ZarrVolume : public VoxelOutput
{
public:
  /** \param sparse chunks of zeros have no file */
  ZarrVolume(const std::filesystem::path & name, bool overwrite, bool sparse, ZarrCompression compression);

  /** Memory that the output takes. */
  static std::uint64_t
  GetMemoryBytes(const VolumeGeometry & geometry, const VoxelLayout & layout, ZarrCompression compression);

  void
  Create(const VolumeGeometry & geometry, const VoxelLayout & layout) override;

  void
  Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data) override;

  void
  Finish() override;

  void
  Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const override;

  bool
  ReadPlane(unsigned int axis, std::uint64_t index, void * data) const override;

  void
  Publish() override;

private:
  struct Slices
  {
    std::uint64_t begin;
    std::uint64_t end;
  };

  Slices
  ToSlices(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const;

  std::filesystem::path
  GetChunkFile(std::uint64_t component, const ZarrIndex & index) const;

  template <typename TFunction>
  void
  ForEachChunkOfLayer(std::uint64_t layer, TFunction && function);

  void
  WriteLayer(std::uint64_t layer, const char * voxels);

  void
  WritePart(std::uint64_t layer, const Slices & slices, const char * voxels);

  void
  CompleteOpenLayer();

  void
  WriteChunk(const std::filesystem::path & chunkFile);

  void
  GiveSpaceBack(std::uint64_t numberOfBytes);

  void
  ReadBox(const ZarrBox & box, void * data) const;

  void
  CheckChunkFiles() const;

  OutputFolder                   m_Folder;
  bool                           m_Sparse;
  ZarrCompression                m_Compression;
  ZarrGrid                       m_Grid;
  std::optional<ZarrChunkWriter> m_Writer;
  std::optional<SpaceReserve>    m_Reserve;
  mutable std::vector<char>      m_Chunk;           ///< memory for one
  std::optional<std::uint64_t>   m_OpenLayer;       ///< some of its slices are written
  std::vector<bool>              m_HasPart;         ///< of each of its chunks
  std::uint64_t                  m_ChunkFiles{ 0 }; ///< complete ones
};

} // end namespace medialvoxel

#endif
