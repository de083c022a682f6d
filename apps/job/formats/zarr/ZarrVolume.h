// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrVolume_h
#define medialvoxelZarrVolume_h

#include "OutputFolder.h"
#include "SharedVolume.h"
#include "SpaceReserve.h"
#include "ZarrChunkFile.h"
#include "ZarrChunks.h"
#include "ZarrLayerWriter.h"

#include <memory>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class ZarrVolume
 * \brief A folder with a volume as OME-Zarr 0.4: an array of Zarr's version 2, its chunks in files.
 *
 * Slices come in any division. Incomplete layers of chunks wait in the files of their chunks, so only one chunk is
 * in memory. Clusters must be whole layers. Smaller levels are made when all chunks are there. */
class ZarrVolume : public SharedVolume
{
public:
  /** \param sparse chunks of zeros have no file */
  ZarrVolume(const std::filesystem::path & name, bool overwrite, bool sparse, ZarrCompression compression);

  /** Memory that the output takes. */
  static std::uint64_t
  GetMemory(const VolumeGeometry & geometry, const VoxelLayout & layout, ZarrCompression compression);

  /** Bytes of the smaller levels, when nothing is packed. */
  static std::uint64_t
  GetSizeOfSmallerLevels(const VolumeGeometry & geometry, const VoxelLayout & layout);

  void
  Create(const VolumeGeometry & geometry, const VoxelLayout & layout) override;

  void
  CreateShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix) override;

  void
  RemoveShared(const std::string & suffix) const override;

  void
  OpenShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix) override;

  void
  OpenToPublish(const VolumeGeometry & geometry,
                const VoxelLayout &    layout,
                const std::string &    suffix,
                const Publication &    publication) override;

  void
  StartCluster() override;

  std::uint32_t
  GetChecksum() const override;

  std::uint32_t
  ReadChecksum(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const override;

  void
  Sync() override;

  void
  Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data) override;

  void
  WriteRows(const SliceRange & slices, const RowRange & rows, const void * data) override;

  void
  Finish() override;

  void
  Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const override;

  bool
  ReadPlane(unsigned int axis, std::uint64_t index, void * data) const override;

  void
  Publish() override;

private:
  struct MetadataFile
  {
    std::filesystem::path name; ///< in the folder
    std::string           text;
  };

  struct Reader
  {
    std::unique_ptr<ZarrChunks> chunks;
    ZarrChunks::Buffers         buffers;
  };

  void
  Describe(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & process = "");

  void
  WriteMetadata() const;

  void
  CheckMetadata() const;

  void
  RemovePartialChunks() const;

  SliceRange
  ToSlices(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const;

  std::filesystem::path
  GetChunkFile(std::uint64_t component, const ZarrIndex & index) const;

  template <typename TFunction>
  void
  ForEachChunkOfLayer(std::uint64_t layer, TFunction && function) const;

  void
  ReadBox(const ZarrBox & box, void * data) const;

  void
  WriteSmallerLevels();

  void
  CheckChunkFiles(const std::string & level, std::uint64_t expected) const;

  OutputFolder                           m_Folder;
  bool                                   m_Sparse;
  ZarrCompression                        m_Compression;
  std::vector<ZarrLevel>                 m_Levels;
  ZarrGrid                               m_Grid; ///< of the first one
  std::vector<MetadataFile>              m_Metadata;
  std::optional<ZarrChunkWriter>         m_Writer;
  std::optional<SpaceReserve>            m_Reserve;
  mutable std::optional<Reader>          m_Reader; ///< of the written volume
  mutable std::optional<ZarrLayerWriter> m_Layers;
};

} // end namespace medialvoxel

#endif
