// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffStack_h
#define medialvoxelTiffStack_h

#include "VoxelStream.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace medialvoxel
{

constexpr const char * TiffFormat = "TIFF";

/** The ways of packing that are read, by their numbers in the format. */
enum class TiffCompression : std::uint16_t
{
  None = 1,
  Lzw = 5,
  Deflate = 8,
  PackBits = 32773,
  OldDeflate = 32946
};

/** Some rows of a slice, packed by themselves. */
struct TiffStrip
{
  std::uint64_t offset{ 0 };
  std::uint64_t packedBytes{ 0 };
  std::uint64_t bytes{ 0 }; ///< of its voxels
};

/** What the directories of a file say: slices of one size and type, one after the other. */
struct TiffStack
{
  std::filesystem::path  fileName;
  bool                   bigEndian{ false };
  std::uint64_t          width{ 0 };
  std::uint64_t          height{ 0 };
  std::uint64_t          numberOfSlices{ 0 };
  PixelType              pixelType{ PixelType::UInt8 };
  TiffCompression        compression{ TiffCompression::None };
  bool                   differences{ false }; ///< packed are the differences along each row
  double                 spacingX{ 1.0 };
  double                 spacingY{ 1.0 };
  std::vector<TiffStrip> strips; ///< of all slices, in the order of their voxels
};

/** Reads and checks all directories of a TIFF or BigTIFF file; every strip lies in the file.
 * \throw HeaderError Unreadable, or Corrupt, also for variants that are not read */
TiffStack
ReadTiffStack(const std::filesystem::path & fileName);

/** The voxels of a compressed stack, unpacked strip by strip. */
std::unique_ptr<VoxelStream>
OpenTiffStream(const std::filesystem::path & fileName);

} // end namespace medialvoxel

#endif
