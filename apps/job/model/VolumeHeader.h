// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeHeader_h
#define medialvoxelVolumeHeader_h

#include "PixelType.h"
#include "Warning.h"

#include "itkMedialVoxelFileRegion.h"
#include "itkMedialVoxelGrid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Where the voxels of a volume lie in space; the x axis comes first. */
struct VolumeGeometry
{
  std::vector<std::uint64_t>       size;
  std::vector<double>              spacing;
  std::vector<double>              origin;
  std::vector<std::vector<double>> direction; ///< direction[axis] is the unit vector of that axis
  bool inMillimeters{ false };                ///< whether the file gives millimeters; else the unit is unknown

  unsigned int
  GetDimension() const
  {
    return static_cast<unsigned int>(size.size());
  }

  std::uint64_t
  GetNumberOfVoxels() const;

  /** All voxels; the size along axes that the volume has not is 1. */
  itk::MedialVoxelBox
  GetVoxelBox() const;

  /** The unit of lengths in space, for a reader. */
  std::string
  DescribeUnit() const
  {
    const bool isOne = std::all_of(spacing.begin(), spacing.end(), [](const double length) { return length == 1.0; });
    return inMillimeters ? "mm" : isOne ? "voxels" : "units of the spacing";
  }

  /** Aligns the axes with the axes of space. */
  void
  SetIdentityDirection();

  /** Voxels of one index along the last axis. */
  std::uint64_t
  GetVoxelsPerSlice() const
  {
    return GetNumberOfVoxels() / size.back();
  }
};

/** The geometry of an image with a pixel for each cell of a volume: it begins half a voxel further along each axis
 * that is longer than one voxel. */
VolumeGeometry
GetCellGeometry(const VolumeGeometry & voxels);

/** Describes a headerless file of voxels. */
struct RawDescription
{
  std::vector<std::uint64_t> size;
  PixelType                  pixelType{ PixelType::UInt8 };
  std::uint64_t              headerSize{ 0 };
  bool                       bigEndian{ false };
};

/** Maps numbers of the file to values of the volume: slope * number + intercept. */
struct ValueScale
{
  double slope{ 1.0 };
  double intercept{ 0.0 };
};

struct VolumeFormat;
struct SliceSeries;
class VoxelSource;

/** Which images of a folder or pattern make up a volume. */
struct SliceChoice
{
  std::string                series; ///< instance UID of a DICOM series; empty: the only one
  std::vector<std::uint64_t> range;  ///< first and last slice, counted from 0, or numbers of a pattern; empty: all

  /** The user gives the spacing, so that slices need not be equally far from each other. */
  bool hasSpacing{ false };

  bool
  IsGiven() const
  {
    return !series.empty() || !range.empty();
  }
};

/** Boxes of voxels that a volume is stored in, each by itself. */
struct VolumeChunks
{
  std::array<std::uint64_t, 3> size{ { 1, 1, 1 } }; ///< along x, y and the slices
  std::string                  packing;             ///< in words; empty: they are not packed
  bool                         inShards{ false };   ///< several in one file
  std::uint64_t                bytesPerThread{ 0 }; ///< memory of a thread that reads them
  std::uint64_t                bytesOfIndices{ 0 }; ///< memory of where they are, for all threads together
  std::uint64_t                bytesPerLayer{ 0 };  ///< of chunks beside each other; 0: none is kept for later slices
};

/** Everything there is to know about a volume before its voxels are read. */
struct VolumeHeader
{
  std::filesystem::path fileName;
  const VolumeFormat *  format{ nullptr }; ///< a row of VolumeFormats.cxx; set when the whole header is read
  VolumeGeometry        geometry;
  PixelType             pixelType{ PixelType::UInt8 };
  bool                  bigEndian{ false }; ///< of the numbers as they are read, or unpacked
  std::filesystem::path dataFile; ///< the same as fileName unless the voxels are in a file, or files, of their own
  std::uint64_t         dataFileSize{ 0 };
  std::uint64_t         dataOffset{ 0 }; ///< bytes of the data file before the voxels or before the compressed stream
  bool                  compressed{ false };
  std::uint64_t         skipAfterInflation{ 0 }; ///< unpacked bytes before the voxels

  /** Where uncompressed voxels lie, when they are in several places or files, one after the other; empty: in one
   * place. */
  std::vector<itk::MedialVoxelFileSegment> segments;
  bool                      liesInRows{ true }; ///< so that several threads read it at once; not in tiles or chunks
  std::optional<ValueScale> scale;              ///< of the numbers in the file; none: they are the values

  /** Memory that reading takes beside voxels and a few MiB: the largest strip of a compressed TIFF, a row of its tiles.
   */
  std::uint64_t decoderMemory{ 0 };

  std::optional<VolumeChunks> chunks; ///< of volumes that are stored so

  unsigned int level{ 0 }; ///< of an image that is there in several sizes, 0 the largest
  unsigned int numberOfLevels{ 1 };

  /** Numbers of a compressed volume for readers of any part, by UnpackVolume(); null: they only come from front to
   * back.
   */
  std::shared_ptr<VoxelSource> unpacked;

  /** The slices of a volume whose slices are images of their own. */
  std::shared_ptr<const SliceSeries> series;

  /** Assumptions and choices made while the header was read. */
  std::vector<Warning> warnings;

  /** The stored volume, when it is resampled while it is read. */
  std::shared_ptr<const VolumeHeader> stored;

  const VolumeHeader &
  GetStored() const
  {
    return stored ? *stored : *this;
  }

  std::uint64_t
  GetDataSize() const
  {
    return geometry.GetNumberOfVoxels() * GetTraits(pixelType).bytes;
  }

  /** The type of the values that are read; pixelType is the type of the numbers in the file. */
  PixelType
  GetValueType() const
  {
    return scale ? PixelType::Float64 : pixelType;
  }

  /** Why and how the volume is read as it is, in words. */
  std::string
  DescribeReading() const;
};

/** Bytes that each file of a volume that is not compressed must have to hold its voxels. */
std::map<std::filesystem::path, std::uint64_t>
GetNeededFileSizes(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
