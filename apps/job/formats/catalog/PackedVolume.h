// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPackedVolume_h
#define medialvoxelPackedVolume_h

#include "OutputFile.h"
#include "VolumeFormat.h"
#include "VoxelOutput.h"

#include <memory>
#include <vector>

namespace medialvoxel
{

/** \class PackedVolume
 * \brief A volume in one file that is packed as one stream, while it is written from its first slice to its last.
 *
 * The bytes of the file depend on the voxels alone: the stream takes them in blocks of one size. Read() unpacks from
 * the begin, or goes on where it ended. */
class PackedVolume : public VoxelOutput
{
public:
  /** \throw JobError Usage for an extension that is not written. */
  PackedVolume(const std::filesystem::path & fileName, bool overwrite);
  ~PackedVolume() override;

  void
  Create(const VolumeGeometry & geometry, const VoxelLayout & layout) override;

  /** Voxels between the end of the last call and the first voxel become zero. */
  void
  Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data) override;

  void
  Finish() override;

  void
  Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const override;

  void
  Publish() override;

  /** Memory that a volume takes while it is written or read. */
  static std::uint64_t
  GetMemory()
  {
    return std::uint64_t{ 1 } << 20;
  }

private:
  struct Deflater;
  struct Inflater;

  void
  Pack(const char * data, std::uint64_t numberOfBytes);

  void
  PackZeros(std::uint64_t numberOfBytes);

  const VolumeWriter &      m_Writer;
  OutputFile                m_File;
  VolumeGeometry            m_Geometry;
  VoxelLayout               m_Layout;
  std::unique_ptr<Deflater> m_Deflater;

  mutable std::unique_ptr<Inflater> m_Inflater; ///< where the last Read() ended

  std::uint64_t m_HeaderSize{ 0 };     ///< before the stream
  std::uint64_t m_UnpackedHeader{ 0 }; ///< bytes of the stream before the voxels
  std::uint64_t m_NextByte{ 0 };       ///< of the voxels
};

} // end namespace medialvoxel

#endif
