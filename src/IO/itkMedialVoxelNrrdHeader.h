// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNrrdHeader_h
#define itkMedialVoxelNrrdHeader_h

#include "MedialVoxelExport.h"

#include "itkMedialVoxelFileRegion.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace itk
{

/** The checked header of a NRRD file, without a look at its data.
 *
 * The axes are the 2 or 3 axes of space, x first; an axis of components, which must be the first of the file, is not
 * among them. Positions are in ITK's space, in which x, y, z point left, posterior, superior: right or anterior axes of
 * a known space are reversed. */
struct MedialVoxelNrrdHeader
{
  std::filesystem::path              fileName;
  std::string                        componentType; ///< uint8, int8, ..., uint64, int64, float32 or float64
  unsigned int                       bytesPerComponent{ 1 };
  bool                               bigEndian{ false };
  std::string                        encoding;      ///< in lower case
  std::string                        componentKind; ///< as the format writes it; empty without an axis of components
  std::uint64_t                      numberOfComponents{ 1 };
  std::vector<std::uint64_t>         size;
  std::vector<double>                spacing;
  std::vector<double>                origin;
  std::vector<std::vector<double>>   direction;        ///< direction[axis] is the unit vector of that axis
  std::string                        space;            ///< name of the space of the positions; empty if it has none
  std::vector<std::vector<double>>   measurementFrame; ///< empty without one
  std::vector<std::filesystem::path> dataFiles;        ///< the same as fileName when the data are attached
  std::uint64_t                      endOfHeader{ 0 };
  std::uint64_t                      lineSkip{ 0 };
  std::int64_t                       byteSkip{ 0 }; ///< -1: the data end with their file
  std::map<std::string, std::string> fields;        ///< values by name (in lower case, without blanks)
  std::map<std::string, std::string> keyValues;     ///< pairs that the format leaves to its users

  bool
  IsAttached() const
  {
    return dataFiles.empty() || dataFiles.front() == fileName;
  }

  /** Bytes of all voxels; a valid file offset. */
  std::uint64_t
  GetNumberOfBytes() const;
};

/** Reads and checks the header of an attached or detached NRRD file.
 * \throw MedialVoxelText::HeaderError Unreadable without such a file, Unsupported for valid headers of another kind
 * (not 2 or 3 axes of space, components that do not come first or are masked, types other than numbers of 1 to 8
 * bytes), Corrupt for all else */
MedialVoxel_EXPORT MedialVoxelNrrdHeader
ReadMedialVoxelNrrdHeader(const std::filesystem::path & fileName);

/** The value of the field `encoding` in lower case, of however damaged a header; empty without one.
 * \throw MedialVoxelText::HeaderError Unreadable */
MedialVoxel_EXPORT std::string
                   FindMedialVoxelNrrdEncoding(const std::filesystem::path & fileName);

/** Bytes of a data file before the bytes that `byte skip` counts.
 * \throw MedialVoxelText::HeaderError when the file has fewer lines than are to be skipped */
MedialVoxel_EXPORT std::uint64_t
SkipMedialVoxelNrrdLines(const MedialVoxelNrrdHeader & header, const std::filesystem::path & dataFile);

/** The text of a header, with the empty line that ends it: type, sizes, geometry, byte order, encoding, data file and
 * key/value pairs. Without data files, or with its own name as the only one, the data are attached. In 3-D the space is
 * left-posterior-superior. */
MedialVoxel_EXPORT std::string
                   MakeMedialVoxelNrrdText(const MedialVoxelNrrdHeader & header);

/** Where the voxels of raw encoding lie.
 * \throw MedialVoxelText::HeaderError when a data file is missing or too short */
MedialVoxel_EXPORT std::vector<MedialVoxelFileSegment>
                   LocateMedialVoxelNrrdVoxels(const MedialVoxelNrrdHeader & header);

} // end namespace itk

#endif
