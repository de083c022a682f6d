// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffFile_h
#define medialvoxelTiffFile_h

#include "BinaryHeader.h"
#include "HeaderParsing.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace medialvoxel
{

/** No more slices than this are believed to be in a file. */
constexpr std::uint64_t MaximumTiffSlices = std::uint64_t{ 1 } << 20;

/** The entries of a directory that are read. */
enum TiffTag : std::uint16_t
{
  SubfileType = 254,
  ImageWidth = 256,
  ImageLength = 257,
  BitsPerSample = 258,
  Compression = 259,
  Photometric = 262,
  ImageDescription = 270,
  StripOffsets = 273,
  Orientation = 274,
  SamplesPerPixel = 277,
  RowsPerStrip = 278,
  StripByteCounts = 279,
  XResolution = 282,
  YResolution = 283,
  ResolutionUnit = 296,
  Predictor = 317,
  TileWidth = 322,
  SampleFormat = 339
};

/** Where the values of an entry lie. */
struct TiffEntry
{
  unsigned int  type{ 0 };
  std::uint64_t count{ 0 };
  std::uint64_t offset{ 0 }; ///< of the values in the file
};

/** One directory, which describes one slice. */
using TiffDirectory = std::map<std::uint16_t, TiffEntry>;

/** \class TiffFile
 * \brief Random access to the numbers of a TIFF or BigTIFF file, none of which is believed to lie in it before it was
 * read. All functions throw HeaderError when the file is damaged. */
class TiffFile
{
public:
  explicit TiffFile(const std::filesystem::path & fileName);

  /** \throw HeaderError Corrupt with the name of the file. */
  [[noreturn]] void
  Refuse(const std::string & what) const;

  bool
  IsBigEndian() const
  {
    return m_BigEndian;
  }

  std::uint64_t
  GetSize() const
  {
    return m_Size;
  }

  /** The next directory of the chain, of which there is at least one; false after the last. Only one of them is kept,
   * as there may be as many as slices. */
  bool
  ReadNextDirectory(TiffDirectory & directory);

  /** Whole numbers of an entry; \a preset when there is none. */
  std::vector<std::uint64_t>
  GetNumbers(const TiffDirectory & directory, TiffTag tag, const std::vector<std::uint64_t> & preset);

  /** The only whole number of an entry. */
  std::uint64_t
  GetNumber(const TiffDirectory & directory, TiffTag tag, std::optional<std::uint64_t> preset = std::nullopt);

  /** A ratio of whole numbers, rounded to single precision as by other readers; 1 when there is none. */
  double
  GetRatio(const TiffDirectory & directory, TiffTag tag);

  /** The text of an entry; empty when there is none. */
  std::string
  GetText(const TiffDirectory & directory, TiffTag tag);

private:
  BinaryHeader
  ReadBytes(std::uint64_t offset, std::uint64_t count);

  std::uint64_t
  ReadOffset(std::uint64_t offset);

  /** Reads the directory at an offset, which becomes that of the next one. */
  TiffDirectory
  ReadDirectory(std::uint64_t & offset);

  BinaryHeader
  ReadValues(const TiffEntry & entry, unsigned int bytesPerValue);

  std::filesystem::path   m_FileName;
  std::ifstream           m_File;
  std::uint64_t           m_Size;
  bool                    m_BigEndian{ false };
  bool                    m_IsBig{ false };
  std::uint64_t           m_NextDirectory{ 0 };
  std::set<std::uint64_t> m_DirectoryOffsets;
};

} // end namespace medialvoxel

#endif
