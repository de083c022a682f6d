// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SegmentFiles.h"

#include "ColorTable.h"
#include "Errors.h"
#include "HeaderParsing.h"
#include "NrrdSegments.h"
#include "Text.h"
#include "VolumeFormat.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

struct SegmentFormat
{
  const char * extension;
  SegmentTable (*read)(const std::filesystem::path &);
};

constexpr SegmentFormat Formats[] = {
  { ".ctbl", ReadBlankTable }, { ".txt", ReadBlankTable },    { ".csv", ReadCommaTable },
  { ".tsv", ReadTabTable },    { ".nrrd", ReadNrrdSegments }, { ".nhdr", ReadNrrdSegments },
};

/** Null for another extension. */
const SegmentFormat *
FindFormat(const std::filesystem::path & fileName)
{
  const std::string extension = ToLower(fileName.extension().string());
  const auto        found = std::find_if(
    std::begin(Formats), std::end(Formats), [&](const SegmentFormat & row) { return extension == row.extension; });
  return found == std::end(Formats) ? nullptr : found;
}

SegmentTable
Read(SegmentTable (*read)(const std::filesystem::path &), const std::filesystem::path & fileName)
try
{
  return read(fileName);
}
catch (const HeaderError & error)
{
  const bool isUnreadable = error.GetKind() == HeaderError::Kind::Unreadable;
  throw JobError(isUnreadable ? ExitStatus::Failure : ExitStatus::CorruptInput, error.what());
}

} // namespace

std::vector<std::string>
ListSegmentExtensions()
{
  std::vector<std::string> extensions;
  for (const SegmentFormat & format : Formats)
  {
    extensions.emplace_back(format.extension);
  }
  return extensions;
}

SegmentTable
ReadSegments(const std::filesystem::path & fileName)
{
  const SegmentFormat * const format = FindFormat(fileName);
  if (format == nullptr)
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": unknown format; names of segments are read from ",
         Join(ListSegmentExtensions(), ", ", [](const std::string & extension) { return extension; }));
  }
  return Read(format->read, fileName);
}

SegmentTable
ReadSegmentsOfVolume(const VolumeHeader & header)
{
  const auto read = header.format->input.readSegments;
  return read ? Read(read, header.fileName) : SegmentTable{};
}

void
CheckSegments(const std::filesystem::path & fileName, const SegmentTable & table)
{
  const std::size_t     number = table.GetSegments().size();
  const SegmentFormat * format = FindFormat(fileName);
  if (format != nullptr && format->read == ReadNrrdSegments && number > MostNrrdSegments)
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": there are ",
         number,
         " segments, and a segmentation has up to ",
         MostNrrdSegments,
         "; select labels, or name it .mha");
  }
}

} // end namespace medialvoxel
