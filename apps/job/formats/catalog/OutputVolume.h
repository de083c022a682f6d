// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputVolume_h
#define medialvoxelOutputVolume_h

#include "Checksum.h"
#include "OutputFile.h"
#include "SharedVolume.h"
#include "VolumeFormats.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace medialvoxel
{

/** \class OutputVolume
 * \brief An uncompressed volume file that is written in parts and appears only when it is complete.
 *
 * Formats of two files: the voxels take a name that no file has, then the header takes its place, and then the
 * voxels that the replaced header named are removed, so that at any moment the header's name stands for one complete
 * volume, the old or the new one. Processes may write one volume at the same time: the last one stays, and no other
 * voxels do. */
class OutputVolume : public SharedVolume
{
public:
  /** \throw JobError Usage for an extension that is not written. */
  OutputVolume(const std::filesystem::path & fileName, bool overwrite, bool sparse);

  /** Creates the files and, unless sparse, takes their space from the disk. \throw JobError Refused. */
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

  std::filesystem::path
  FindFreeDataName() const override;

  void
  StartCluster() override;

  std::uint32_t
  GetChecksum() const override;

  std::uint32_t
  ReadChecksum(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const override;

  void
  Sync() override;

  /** Writes a large volume past the page cache from now on; to be called after Create(). */
  void
  BypassPageCacheWhenLarge() override;

  /** Writes voxels that follow each other, x fastest. \throw JobError Failure. */
  void
  Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data) override;

  /** Reads back voxels written before. */
  void
  Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const override;

  /** Brings the files to the disk and compares their sizes. \throw JobError Failure. */
  void
  Finish() override;

  /** Gives the files their names. */
  void
  Publish() override;

  const std::filesystem::path &
  GetFileName() const
  {
    return m_Header.GetFileName();
  }

private:
  OutputFile &
  GetVoxelFile()
  {
    return m_Format.extension.isDetached ? m_Data : m_Header;
  }
  const OutputFile &
  GetVoxelFile() const
  {
    return m_Format.extension.isDetached ? m_Data : m_Header;
  }

  std::filesystem::path
  GetSharedName(const std::string & suffix) const;

  /** Sets the final content of the files; returns the bytes of the file with the voxels. */
  std::uint64_t
  Describe(const VolumeGeometry & geometry, const VoxelLayout & layout);

  /** The bytes before the voxels in their file. */
  std::string
  GetPreamble() const;

  void
  PublishBoth();

  void
  WriteHeader();

  void
  RemoveReplacedVoxels(const std::filesystem::path & replaced) const;

  OutputFormat   m_Format;
  bool           m_Sparse;
  VolumeGeometry m_Geometry;
  VoxelLayout    m_Layout;
  OutputFile     m_Header; ///< the only file in formats of one file
  OutputFile     m_Data;
  std::uint64_t  m_Offset{ 0 }; ///< of the first voxel in its file
  bool           m_HasDataName{ false };

  std::filesystem::path m_Replaced; ///< file with the voxels of the volume that is to be replaced, when known before

  std::optional<Checksum> m_Checksum; ///< of the voxels of a cluster
};

} // end namespace medialvoxel

#endif
