// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeFormats_h
#define medialvoxelVolumeFormats_h

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

class SharedVolume;
class ValueReader;
class VoxelStream;

/** An extension of a format, and what it says of volumes that are written. */
struct VolumeExtension
{
  const char * text;
  bool         isDetached{ false }; ///< voxels in a file of their own
  bool         isPacked{ false };   ///< the whole file, always
  bool         canPack{ false };    ///< when asked for
  const char * remedy{ "" };        ///< what to name instead of a file that cannot be packed
};

/** What compares the size of the data file with that of the voxels. */
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

  /** Of formats whose images are there in several sizes: reads the header of a level, 0 the largest.
   * \throw JobError Usage, for one that is not there, and as readHeader */
  VolumeHeader (*readLevel)(const std::filesystem::path &, unsigned int){ nullptr };

  /** Of formats whose volumes are folders: true for such a folder. */
  bool (*isFolder)(const std::filesystem::path &){ nullptr };

  /** In place of readHeader, where the options choose among the files that a name stands for. */
  VolumeHeader (*readChoice)(const std::filesystem::path &, const SliceChoice &){ nullptr };

  /** Memory that the readers of so many threads take beside the parts that are read; null: none. */
  std::uint64_t (*getMemory)(const VolumeHeader &, unsigned int){ nullptr };
};

/** How volumes of a format are written. */
struct VolumeWriter
{
  std::unique_ptr<SharedVolume> (*make)(const std::filesystem::path &, const JobOptions &){ nullptr };

  /** The header of a file with voxels in the byte order of this machine; null for folders. Arguments: geometry, layout,
   * the name of the voxels' file beside a detached header, bytes of voxels that are packed. */
  std::string (*makeHeader)(const VolumeGeometry &,
                            const VoxelLayout &,
                            const std::string &,
                            const std::optional<std::uint64_t> &){ nullptr };

  bool          packsChunks{ false };  ///< when the options say so
  bool          packsHeader{ false };  ///< with the voxels, when they are packed
  bool          packsAsZlib{ false };  ///< otherwise as gzip
  bool          hasComponents{ true }; ///< those of a voxel may lie beside each other
  std::uint64_t largestSize{ 0 };      ///< along an axis; 0: any

  /** Memory beside the results of a piece, and slices that are written together. Null: none, and each by itself. */
  std::uint64_t (*getMemory)(const VolumeGeometry &, const VoxelLayout &, const JobOptions &){ nullptr };
  std::uint64_t (*getSlicesOfLayer)(const VolumeGeometry &, const VoxelLayout &){ nullptr };

  /** Rows of these slices that are written together. Null: all of them. */
  std::uint64_t (*getRowsOfLayer)(const VolumeGeometry &, const VoxelLayout &){ nullptr };

  /** Bytes that are written beside the voxels, when nothing is packed. Null: next to none. */
  std::uint64_t (*getFurtherBytes)(const VolumeGeometry &, const VoxelLayout &){ nullptr };
};

/** A format of volumes: a row of the table in VolumeFormats.cxx, which all that lists formats reads. */
struct VolumeFormat
{
  const char *                 name; ///< in reports
  std::vector<VolumeExtension> extensions;
  VolumeInput                  input;
  std::optional<VolumeWriter>  writer; ///< nothing: it is only read

  bool
  IsFolder() const
  {
    return input.isFolder != nullptr;
  }
};

/** Of headerless files. */
const VolumeFormat &
GetRawFormat();

/** Of folders and patterns of images, each of which is a slice. */
const VolumeFormat &
GetSeriesFormat();

/** The format of an existing file or folder, or of a pattern of slices. \throw JobError Usage for an unknown one */
const VolumeFormat &
FindInputFormat(const std::filesystem::path & fileName);

/** How a volume of a name is written. */
struct OutputFormat
{
  const VolumeFormat &    format;
  const VolumeExtension & extension;
};

/** \throw JobError Usage for an extension that is not written. */
OutputFormat
FindOutputFormat(const std::filesystem::path & fileName);

/** Extensions of the volumes that are read. */
std::vector<std::string>
ListInputExtensions();

/** Names of the formats that are read. */
std::vector<std::string>
ListInputFormats();

/** Extensions of the volumes that are written: those of formats that have so many components. */
std::vector<std::string>
ListOutputExtensions(unsigned int components = 1);

/** True for a volume whose file is packed as a whole: by its extension, or when \a compress asks for it and the format
 * has it. The chunks of Zarr folders are another matter. */
bool
IsPackedVolume(const std::filesystem::path & fileName, bool compress);

/** The same, or in chunks: how many bytes it will have is not known. */
bool
IsPackedInAnyWay(const std::filesystem::path & fileName, const JobOptions & options);

/** Refuses what a format does not have. \throw JobError Usage */
void
CheckOutputFormat(const std::filesystem::path & fileName,
                  const VolumeGeometry &        geometry,
                  const VoxelLayout &           layout,
                  bool                          compress);

/** Memory that writing a volume takes beside the results of a piece. */
std::uint64_t
GetOutputMemory(const std::filesystem::path & fileName,
                const VolumeGeometry &        geometry,
                const VoxelLayout &           layout,
                const JobOptions &            options);

/** Bytes of a volume that is written, when it is not packed. */
std::uint64_t
GetOutputBytes(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout);

/** Slices of a volume that are written together. */
std::uint64_t
GetSlicesOfLayer(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout);

/** Rows of such slices that VoxelOutput::WriteRows() takes together; 0 when slices are written as a whole. */
std::uint64_t
GetRowsOfLayer(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout);

} // end namespace medialvoxel

#endif
