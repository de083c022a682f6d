// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSliceSeries_h
#define medialvoxelSliceSeries_h

#include "PixelType.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Where a slice lies in space, in millimeters. */
struct SlicePlace
{
  std::array<double, 3> origin;          ///< center of the first voxel
  std::array<double, 3> rowAxis;         ///< unit vector of increasing columns
  std::array<double, 3> columnAxis;      ///< unit vector of increasing rows
  double                rounding{ 0.0 }; ///< of the numbers of the origin, as they are written
};

struct DicomFrame;

/** The header of the image of a slice. */
struct SliceHeader
{
  std::filesystem::path                fileName;
  std::array<std::uint64_t, 2>         size{ { 0, 0 } }; ///< columns and rows
  PixelType                            pixelType{ PixelType::UInt8 };
  std::array<double, 2>                spacing{ { 1.0, 1.0 } };
  std::optional<SlicePlace>            place;      ///< of DICOM
  std::optional<PixelType>             storedType; ///< of DICOM: of the slice alone
  bool                                 isSpacingKnown{ true };
  bool                                 inMillimeters{ false };  ///< its spacing
  bool                                 isDistanceKnown{ true }; ///< of its place to that of others
  std::optional<std::int64_t>          number;                  ///< of the DICOM instance
  std::optional<std::array<double, 2>> padding;            ///< of DICOM: from and to, of values that are no measurement
  std::string                          acquisition;        ///< of DICOM: distinguishes the scans of one series
  std::string                          series;             ///< instance UID of the DICOM series; empty: none
  std::string                          description;        ///< of the series
  std::uint64_t                        decoderMemory{ 0 }; ///< memory that decoding takes beside the slice

  /** Where the image is in a file of DICOM. */
  std::shared_ptr<const DicomFrame> frame;
  std::uint64_t                     frameNumber{ 0 }; ///< from 1; 0: the file has one image

  /** For messages. */
  std::string
  GetName() const
  {
    return fileName.string() + (frameNumber > 0 ? " frame " + std::to_string(frameNumber) : "");
  }

  std::uint64_t
  GetDataSize() const
  {
    return size[0] * size[1] * GetTraits(pixelType).bytes;
  }
};

/** A format of images that are slices: a row of the table in SliceFormats.cxx. */
struct SliceFormat
{
  const char *              name;
  std::vector<const char *> extensions;

  bool isInput; ///< also of a volume by itself: a file may have several slices

  /** Whether a file with another extension is of the format; null: never. */
  bool (*isKnown)(const std::filesystem::path &);

  /** Nothing for a file of the format that has no image. \throw HeaderError */
  std::vector<SliceHeader> (*readHeaders)(const std::filesystem::path &);

  /** Reads all values of the slice, x fastest, in the byte order of this machine.
   * \throw HeaderError when they are damaged, end early, or are others than the header said */
  void (*readVoxels)(const SliceHeader &, void *);

  /** Memory that reading takes once, for the libraries. */
  std::uint64_t libraryMemory;

  /** The option of the build that reads the format; empty: built. */
  const char * remedy{ "" };
};

class SliceCache;

/** \class SliceSeries
 * \brief Images that make up a volume, in order along its last axis: all of one size and type. */
struct SliceSeries
{
  const SliceFormat *      format{ nullptr };
  std::vector<SliceHeader> slices;

  /** Slices that were decoded last, for all readers of the volume. */
  std::shared_ptr<SliceCache> cache;
};

} // end namespace medialvoxel

#endif
