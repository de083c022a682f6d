// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrPyramid_h
#define medialvoxelZarrPyramid_h

#include "ZarrChunkFile.h"
#include "ZarrMetadata.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** The levels of a volume that is written, the volume itself first. Labels get smaller ones until no side is longer
 * than 256, for programs that show large images: each voxel is the largest label of the up to 8 that it stands for. All
 * levels have chunks of one shape. */
std::vector<ZarrLevel>
MakeZarrLevels(const VolumeGeometry & geometry, const VoxelLayout & layout);

/** The array of a level that is written. */
ZarrArray
MakeZarrArray(const ZarrGrid & grid, ZarrCompression compression);

/** \class ZarrPyramid
 * \brief Writes a level from the chunks of the one before, with memory for two chunks. */
class ZarrPyramid
{
public:
  /** \param folder of the whole image */
  ZarrPyramid(const std::filesystem::path & folder, ZarrCompression compression, ZarrChunkWriter & writer);

  /** Writes the chunks that do not hold zeros alone. \return their number. \throw JobError */
  std::uint64_t
  Write(const ZarrLevel & from, const ZarrLevel & to);

private:
  std::filesystem::path m_Folder;
  ZarrCompression       m_Compression;
  ZarrChunkWriter &     m_Writer;
};

} // end namespace medialvoxel

#endif
