// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelHeaderParsing_h
#define medialvoxelHeaderParsing_h

#include "VolumeHeader.h"

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Header text of a volume: its fields by name and the offset of the byte after it. */
struct HeaderFields
{
  std::map<std::string, std::string> values;
  std::uint64_t                      endOfHeader{ 0 };

  /** The value of a field, or nothing. */
  std::optional<std::string>
  Find(const std::string & name) const;
};

/** \class HeaderLines
 * \brief Hands out the lines of a header and refuses what no header has: endless lines, bytes that are not text. */
class HeaderLines
{
public:
  /** \throw JobError when the file cannot be opened or is not a regular file. */
  HeaderLines(const std::filesystem::path & fileName, std::uint64_t maximumBytesPerLine);

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
  std::uint64_t         m_MaximumBytesPerLine;
  std::uint64_t         m_Position{ 0 };
  std::uint64_t         m_LineNumber{ 0 };
};

/** Opens for reading. \throw JobError Failure when the file is missing, unreadable or not a regular file. */
std::ifstream
OpenRegularFile(const std::filesystem::path & fileName);

/** Size of an existing file. \throw JobError CorruptInput when the data file of a header is missing. */
std::uint64_t
GetDataFileSize(const std::filesystem::path & headerName, const std::filesystem::path & dataFile);

/** \throw JobError CorruptInput with the name of the file. */
[[noreturn]] void
RefuseHeader(const std::filesystem::path & fileName, const std::string & what);

/** The value of a field. \throw JobError CorruptInput when there is none. */
std::string
RequireField(const std::filesystem::path & fileName, const HeaderFields & fields, const std::string & name);

/** Numbers of a header field. \throw JobError CorruptInput unless there are \a count, each finite. */
std::vector<double>
ParseNumbers(const std::filesystem::path & fileName, const std::string & field, const std::string & text, size_t count);

/** Numbers of a header field. \throw JobError CorruptInput unless there are \a count, each positive and finite. */
std::vector<double>
ParseSpacings(const std::filesystem::path & fileName,
              const std::string &           field,
              const std::string &           text,
              size_t                        count);

/** Sizes of a header field. \throw JobError CorruptInput unless there are 2 or 3, each at least 1, with a product of
 * voxels and bytes that can be addressed. */
std::vector<std::uint64_t>
ParseSizes(const std::filesystem::path & fileName, const std::string & field, const std::string & text, size_t count);

VolumeHeader
ReadMetaImageHeader(const std::filesystem::path & fileName);
VolumeHeader
ReadNrrdHeader(const std::filesystem::path & fileName);

/** Fills in spacing, origin and direction from the fields of a NRRD header, in the space that ITK uses. */
void
ReadNrrdGeometry(VolumeHeader & header, const HeaderFields & fields);

} // end namespace medialvoxel

#endif
