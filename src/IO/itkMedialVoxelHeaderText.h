// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelHeaderText_h
#define itkMedialVoxelHeaderText_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace itk
{
namespace MedialVoxelText
{

/** Makes a text from a file safe to show: control characters, which can steer a terminal, become question marks. */
MedialVoxel_EXPORT std::string
                   MakePrintable(std::string text);

/** \class HeaderError
 * \brief An error in the header of a volume; the text names the file.
 * \ingroup MedialVoxel */
class MedialVoxel_EXPORT HeaderError : public std::runtime_error
{
public:
  enum class Kind : std::uint8_t
  {
    Unreadable, ///< the file is missing, cannot be opened, or is not a regular file
    Corrupt,    ///< the header, or its statement about the data, is damaged or inconsistent
    Unsupported ///< a variant of the format that is valid but not read
  };

  HeaderError(Kind kind, const std::string & message);

  Kind
  GetKind() const
  {
    return m_Kind;
  }

private:
  Kind m_Kind;
};

/** Header text of a volume: its fields by name and the offset of the byte after it. */
struct MedialVoxel_EXPORT HeaderFields
{
  std::map<std::string, std::string> values;
  std::uint64_t                      endOfHeader{ 0 };

  /** The value of a field, or nothing. */
  std::optional<std::string>
  Find(const std::string & name) const;
};

/** \class HeaderLines
 * \brief Hands out the lines of a header and refuses endless lines and bytes that are not text.
 * \ingroup MedialVoxel */
class MedialVoxel_EXPORT HeaderLines
{
public:
  /** \throw HeaderError when the file cannot be opened or is not a regular file. */
  HeaderLines(const std::filesystem::path & fileName, std::uint64_t maximumLineLength);

  /** The next line without its end; false at the end of the file. */
  bool
  Next(std::string & line);

  std::uint64_t
  GetPosition() const
  {
    return m_Position;
  }

  std::uint64_t
  GetLineNumber() const
  {
    return m_LineNumber;
  }

private:
  std::filesystem::path m_FileName;
  std::ifstream         m_File;
  std::uint64_t         m_MaximumLineLength;
  std::uint64_t         m_Position{ 0 };
  std::uint64_t         m_LineNumber{ 0 };
};

/** Opens for reading. \throw HeaderError Unreadable when the file is missing, unreadable or not a regular file. */
MedialVoxel_EXPORT std::ifstream
                   OpenRegularFile(const std::filesystem::path & fileName);

/** The data file that a header names, beside it; a name in Latin-1 finds the file whose name is the same in UTF-8. */
MedialVoxel_EXPORT std::filesystem::path
                   FindDataFile(const std::filesystem::path & headerName, const std::string & name);

/** Size of an existing file. \throw HeaderError Corrupt when the data file of a header is missing. */
MedialVoxel_EXPORT std::uint64_t
                   GetDataFileSize(const std::filesystem::path & headerName, const std::filesystem::path & dataFile);

/** \throw HeaderError Corrupt with the name of the file; of long values in \a what the middle is left out. */
[[noreturn]] MedialVoxel_EXPORT void
RefuseHeader(const std::filesystem::path & fileName,
             const std::string &           what,
             HeaderError::Kind             kind = HeaderError::Kind::Corrupt);

/** The value of a field. \throw HeaderError Corrupt when there is none. */
MedialVoxel_EXPORT std::string
RequireField(const std::filesystem::path & fileName, const HeaderFields & fields, const std::string & name);

/** Numbers of a header field. \throw HeaderError Corrupt unless there are \a count, each finite. */
MedialVoxel_EXPORT std::vector<double>
ParseNumbers(const std::filesystem::path & fileName, const std::string & field, const std::string & text, size_t count);

/** Numbers of a header field. \throw HeaderError Corrupt unless there are \a count, each positive and finite. */
MedialVoxel_EXPORT std::vector<double>
                   ParseSpacings(const std::filesystem::path & fileName,
                                 const std::string &           field,
                                 const std::string &           text,
                                 size_t                        count);

/** Sizes of a header field. \throw HeaderError Corrupt unless there are 2 or 3, each at least 1, with a product of
 * voxels and bytes that can be addressed. */
MedialVoxel_EXPORT std::vector<std::uint64_t>
ParseSizes(const std::filesystem::path & fileName, const std::string & field, const std::string & text, size_t count);

} // end namespace MedialVoxelText
} // end namespace itk

#endif
