// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffFile_h
#define medialvoxelTiffFile_h

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <tiffio.h>

namespace medialvoxel
{

/** How a slice is divided into bands of rows, which are strips, or rows of tiles. */
struct TiffBands
{
  std::uint64_t width{ 0 };
  std::uint64_t height{ 0 };
  std::uint64_t rows{ 0 };      ///< of a band
  std::uint64_t tileWidth{ 0 }; ///< 0: strips

  std::uint64_t
  GetCount() const
  {
    return rows == 0 ? 0 : (height + rows - 1) / rows;
  }

  /** Strips or tiles of a band: striles, as libtiff says. */
  std::uint64_t
  GetStriles() const
  {
    return tileWidth == 0 ? 1 : (width + tileWidth - 1) / tileWidth;
  }

  /** Rows of a band; the last one may have less than the others. */
  std::uint64_t
  GetRows(std::uint64_t band) const
  {
    return std::min(rows, height - std::min(height, band * rows));
  }
};

/** \class TiffFile
 * \brief A TIFF or BigTIFF file in the hands of libtiff, which keeps one directory, of one slice, at a time.
 *
 * Complaints of libtiff become part of the errors and are not printed; its warnings are dropped. It reads through
 * this class, which refuses reads behind the end of the file: libtiff takes some of them for zeros. */
class TiffFile
{
public:
  /** Tables of a directory with more bytes than this are refused. */
  static constexpr std::uint64_t MaximumTableSize = std::uint64_t{ 1 } << 26;

  /** Opens a file and reads its first directory.
   * \param maximumSize no buffer within libtiff has more bytes than this
   * \throw HeaderError Unreadable, or Corrupt when it does not begin with a directory */
  explicit TiffFile(const std::filesystem::path & fileName, std::uint64_t maximumSize = MaximumTableSize);
  TiffFile(const TiffFile &) = delete;
  TiffFile &
  operator=(const TiffFile &) = delete;

  /** \throw HeaderError Corrupt with the name of the file, and with the complaint of libtiff if there is one. */
  [[noreturn]] void
  Refuse(const std::string & what) const;

  /** Reads the next directory; false when there is none. \throw HeaderError Corrupt when it is damaged. */
  bool
  NextDirectory();

  /** The value of a tag of the directory, of the type that libtiff has for it; \a preset when there is none. */
  template <typename TValue>
  TValue
  Get(std::uint32_t tag, TValue preset) const
  {
    TValue value{};
    return TIFFGetField(m_Handle.get(), tag, &value) == 1 ? value : preset;
  }

  /** For further tags of the directory. */
  TIFF *
  GetHandle() const
  {
    return m_Handle.get();
  }

  /** Where the directory lies. */
  std::uint64_t
  GetDirectoryOffset() const;

  /** Reads the directory that lies there. \throw HeaderError Corrupt when it is damaged. */
  void
  SetDirectory(std::uint64_t offset);

  TiffBands
  GetBands() const;

  /** Memory that ReadBand() takes, with the voxels. */
  std::uint64_t
  GetBandMemory(std::uint64_t band) const;

  /** Unpacks the rows of a band into the byte order of the machine. Returns the bytes that it has in the file.
   * \throw HeaderError Corrupt when it is damaged or has not \a numberOfBytes */
  std::uint64_t
  ReadBand(std::uint64_t band, char * voxels, std::uint64_t numberOfBytes);

private:
  struct Closer
  {
    void
    operator()(TIFF * handle) const
    {
      TIFFClose(handle);
    }
  };

  static tmsize_t
  Read(thandle_t file, void * bytes, tmsize_t numberOfBytes);
  static toff_t
  Seek(thandle_t file, toff_t offset, int from);
  static toff_t
  GetSize(thandle_t file);
  static int
  KeepComplaint(TIFF *, void * file, const char *, const char * format, va_list values);
  static int
  DropWarning(TIFF *, void *, const char *, const char *, va_list);

  /** Counts unpacked voxels: one bit becomes a byte. */
  std::uint64_t
  GetBytesPerVoxel() const;

  bool
  HasBits() const;

  /** Reads a strip or tile of so many rows and voxels in a row. */
  void
  ReadStrile(std::uint64_t strile, std::uint64_t width, std::uint64_t rows, char * voxels);

  void
  ReadTiles(const TiffBands & bands, std::uint64_t band, char * voxels);

  /** Libtiff found all bytes of the directory. */
  void
  CheckDirectory(bool isRead, const char * what) const;

  std::filesystem::path         m_FileName;
  std::ifstream                 m_File;
  std::uint64_t                 m_Size;
  bool                          m_EndsEarly{ false };
  std::string                   m_Complaint; ///< the first one, the cause of the later ones
  std::unique_ptr<TIFF, Closer> m_Handle;
  std::vector<char>             m_Tile;
  std::vector<unsigned char>    m_Bits; ///< of a strip or tile
};

} // end namespace medialvoxel

#endif
