// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeFormat_h
#define medialvoxelVolumeFormat_h

#include "Options.h"
#include "VolumeHeader.h"
#include "VoxelLayout.h"

#include "itkStreamingRawImageIO.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

class SegmentTable;
class SharedVolume;
class ValueReader;
class VoxelStream;

/** An extension of a format, and the layout of volumes written under it. */
struct VolumeExtension
{
  const char * text;
  bool         isDetached{ false }; ///< voxels in a file of their own
  bool         isPacked{ false };   ///< the whole file, always
  bool         canPack{ false };    ///< when asked for
  const char * remedy{ "" };        ///< the file to name instead of one that cannot be packed
};

/** How the size of the data file is compared with the size of the voxels. */
enum class DataSizeCheck
{
  AtLeast, ///< after the header was read: they have to fit
  Exactly, ///< the same, and nothing may follow
  ByReader ///< each part was, when the header was read, or is, when the part is
};

/** How volumes of a format are read. */
struct VolumeInput
{
  VolumeHeader (*readHeader)(const std::filesystem::path &){ nullptr }; ///< null: a description stands for it
  DataSizeCheck sizeCheck{ DataSizeCheck::AtLeast };

  /** Voxels that are compressed, from front to back. */
  std::unique_ptr<VoxelStream> (*openCompressed)(const VolumeHeader &){ nullptr };

  /** Voxels that are not, in parts. */
  itk::StreamingRawImageIO::Pointer (*makeReader)(const VolumeHeader &){ nullptr };

  /** Voxels in chunks, each by itself; instead of makeReader. Its argument: bytes of chunks that may be kept. */
  std::unique_ptr<ValueReader> (*makeChunkReader)(const VolumeHeader &, std::uint64_t){ nullptr };

  /** Reads the header of a level, 0 the largest, in formats of images in several sizes.
   * \throw JobError Usage, for a missing level, and as readHeader */
  VolumeHeader (*readLevel)(const std::filesystem::path &, unsigned int){ nullptr };

  /** Names of the segments of a label map; null: the format has none. \throw HeaderError */
  SegmentTable (*readSegments)(const std::filesystem::path &){ nullptr };

  /** True for files that the format reads under other extensions; null: never. */
  bool (*isKnown)(const std::filesystem::path &){ nullptr };

  /** Whether a folder is a volume of the format; null: volumes are files. */
  bool (*isFolder)(const std::filesystem::path &){ nullptr };

  /** In place of readHeader, where the options choose among the files that a name stands for. */
  VolumeHeader (*readChoice)(const std::filesystem::path &, const SliceChoice &){ nullptr };

  /** Memory that the readers of so many threads take beside the parts that are read; null: none. */
  std::uint64_t (*getMemory)(const VolumeHeader &, unsigned int){ nullptr };
};

/** How volumes of a format are written. */
struct VolumeWriter
{
  /** Makes the folder of a volume; null: a volume is a file, or two, with this header. */
  std::unique_ptr<SharedVolume> (*makeFolder)(const std::filesystem::path &, const JobOptions &){ nullptr };

  /** The header of a file with voxels in the byte order of this machine; null for folders. Arguments: geometry, layout,
   * the name of the voxels' file beside a detached header, bytes of voxels that are packed. */
  std::string (*makeHeader)(const VolumeGeometry &,
                            const VoxelLayout &,
                            const std::string &,
                            const std::optional<std::uint64_t> &){ nullptr };

  bool          packsChunks{ false };  ///< when the options say so
  bool          packsHeader{ false };  ///< with the voxels, when they are packed
  bool          packsAsZlib{ false };  ///< otherwise as gzip
  bool          hasComponents{ true }; ///< the components of a voxel may lie beside each other
  std::uint64_t largestSize{ 0 };      ///< along an axis; 0: any

  /** Memory beside the results of a piece, and slices that are written together. Null: none, and each by itself. */
  std::uint64_t (*getMemory)(const VolumeGeometry &, const VoxelLayout &, const JobOptions &){ nullptr };
  std::uint64_t (*getSlicesOfLayer)(const VolumeGeometry &, const VoxelLayout &){ nullptr };

  /** Rows of these slices that are written together. Null: all of them. */
  std::uint64_t (*getRowsOfLayer)(const VolumeGeometry &, const VoxelLayout &){ nullptr };

  /** Bytes that are written beside the voxels, when nothing is packed. Null: next to none. */
  std::uint64_t (*getFurtherSize)(const VolumeGeometry &, const VoxelLayout &){ nullptr };
};

/** A format of volumes: a row of the table in VolumeFormats.cxx, which all that lists formats reads. */
struct VolumeFormat
{
  const char *                 name; ///< in reports
  std::vector<VolumeExtension> extensions;
  VolumeInput                  input;
  std::optional<VolumeWriter>  writer{}; ///< nothing: it is only read
  std::string                  remedy{}; ///< the option of the build that adds the format; empty: built

  bool
  IsFolder() const
  {
    return input.isFolder != nullptr;
  }
};

/** Readers of voxels that lie one after the other in a file, or are packed there as one stream. */
VolumeInput
MakePlainInput(VolumeHeader (*readHeader)(const std::filesystem::path &),
               DataSizeCheck sizeCheck = DataSizeCheck::AtLeast);

/** Refuses a format that the program was built without, and names the option of the build. \throw JobError Usage */
[[noreturn]] void
RefuseMissingFormat(const std::filesystem::path & fileName, const std::string & format, const std::string & remedy);

} // end namespace medialvoxel

#endif
