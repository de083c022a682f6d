// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputChecks.h"

#include "DataFile.h"
#include "Errors.h"
#include "FileNames.h"
#include "SliceSeries.h"
#include "VolumeFormats.h"

#include <algorithm>

namespace medialvoxel
{

std::set<std::filesystem::path>
ListInputFiles(const VolumeHeader & input)
{
  std::set<std::filesystem::path> files;
  if (input.series)
  {
    for (const SliceHeader & slice : input.series->slices)
    {
      files.insert(slice.fileName);
    }
    return files;
  }
  files = { input.fileName, input.dataFile };
  for (const itk::MedialVoxelFileSegment & segment : input.segments)
  {
    files.insert(segment.fileName);
  }
  return files;
}

namespace
{

/** Absolute path without links, also of a file that does not exist yet.
 * \throw JobError Refused for a name that the system does not take */
std::filesystem::path
GetPlace(const std::filesystem::path & fileName)
{
  std::error_code             error;
  const std::filesystem::path absolute = std::filesystem::absolute(FollowLinks(fileName), error);
  std::filesystem::path       place = error ? absolute : std::filesystem::weakly_canonical(absolute, error);
  while (error == std::errc::no_such_file_or_directory)
  {
    // Another process removed the file between two looks at it.
    place = std::filesystem::weakly_canonical(absolute, error);
  }
  if (error)
  {
    Fail(ExitStatus::Refused, fileName.string(), " cannot be the name of a file: ", error.message());
  }
  return place;
}

/** One file under two names, by way of links, or one name that no file has yet. */
bool
AreSameFile(const std::filesystem::path & a, const std::filesystem::path & b)
{
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error))
  {
    return true;
  }
  return GetPlace(a) == GetPlace(b);
}

/** True for names below a folder, which need not exist. */
bool
IsInside(const std::filesystem::path & fileName, const std::filesystem::path & folder)
{
  const std::filesystem::path inner = GetPlace(fileName);
  const std::filesystem::path outer = GetPlace(folder);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/** The format of a volume that is wanted as a folder; null for other outputs. */
const VolumeFormat *
GetFolderFormat(const OutputRequest & output)
{
  const VolumeFormat * const format = output.IsVolume() ? &FindOutputFormat(output.fileName).format : nullptr;
  return format && format->IsFolder() ? format : nullptr;
}

/** The format of a folder that will be replaced and holds the input, or that is the input and holds the output; null
 * without one. */
const VolumeFormat *
FindSharedFolder(const OutputRequest & output, const VolumeHeader & input)
{
  const VolumeFormat * const format = GetFolderFormat(output);
  if (format && IsInside(input.dataFile, output.fileName))
  {
    return format;
  }
  return input.format->IsFolder() && IsInside(output.fileName, input.fileName) ? input.format : nullptr;
}

/** The same for one output in the folder of another. */
const VolumeFormat *
FindSharedFolder(const OutputRequest & a, const OutputRequest & b)
{
  const VolumeFormat * const formatOfA = GetFolderFormat(a);
  if (formatOfA && IsInside(b.fileName, a.fileName))
  {
    return formatOfA;
  }
  const VolumeFormat * const formatOfB = GetFolderFormat(b);
  return formatOfB && IsInside(a.fileName, b.fileName) ? formatOfB : nullptr;
}

void
RefuseInput(const OutputRequest & output, const VolumeHeader & input)
{
  if (const VolumeFormat * const folder = FindSharedFolder(output, input))
  {
    Fail(ExitStatus::Usage,
         output.fileName.string(),
         ": the ",
         output.role,
         " and the input ",
         input.fileName.string(),
         " are in one ",
         folder->name,
         " folder");
  }
  const std::filesystem::path dataFile = FindDataFile(output.fileName);
  for (const std::filesystem::path & inputFile : ListInputFiles(input))
  {
    if (AreSameFile(output.fileName, inputFile))
    {
      Fail(ExitStatus::Usage,
           output.fileName.string(),
           ": the ",
           output.role,
           " would replace the input ",
           inputFile.string());
    }
    if (!dataFile.empty() && AreSameFile(dataFile, inputFile))
    {
      Fail(ExitStatus::Usage, output.fileName.string(), ": its data file is the input ", inputFile.string());
    }
  }
}

void
RefuseExisting(const OutputRequest & output, bool overwrite)
{
  std::error_code             error;
  const std::filesystem::path folder = GetPlace(output.fileName).parent_path();
  if (!std::filesystem::is_directory(folder, error))
  {
    Fail(ExitStatus::Refused, output.fileName.string(), ": the folder ", folder.string(), " does not exist");
  }
  const auto status = std::filesystem::status(output.fileName, error);
  if (!std::filesystem::exists(status))
  {
    return;
  }
  if (output.appends)
  {
    return;
  }
  const VolumeFormat * const folderFormat = GetFolderFormat(output);
  if (folderFormat && !folderFormat->input.isFolder(output.fileName))
  {
    Fail(ExitStatus::Refused, output.fileName.string(), " exists and is not a ", folderFormat->name, " folder");
  }
  if (!folderFormat && !std::filesystem::is_regular_file(status))
  {
    Fail(ExitStatus::Refused, output.fileName.string(), " exists and is not a regular file");
  }
  if (!overwrite)
  {
    Fail(ExitStatus::Refused, output.fileName.string(), " exists; it is replaced only with --overwrite");
  }
}

} // namespace

void
CheckOutputs(const std::vector<OutputRequest> & outputs, const VolumeHeader & input, bool overwrite)
{
  for (auto output = outputs.begin(); output != outputs.end(); ++output)
  {
    if (output->layout)
    {
      FindOutputFormat(output->fileName);
    }
    RefuseInput(*output, input);
    for (auto other = outputs.begin(); other != output; ++other)
    {
      if (AreSameFile(other->fileName, output->fileName))
      {
        Fail(ExitStatus::Usage, output->fileName.string(), " is named for both ", other->role, " and ", output->role);
      }
      if (const VolumeFormat * const folder = FindSharedFolder(*output, *other))
      {
        Fail(ExitStatus::Usage,
             output->fileName.string(),
             ": the ",
             output->role,
             " and the ",
             other->role,
             " are in one ",
             folder->name,
             " folder");
      }
    }
  }
  for (const OutputRequest & output : outputs)
  {
    RefuseExisting(output, overwrite);
  }
}

void
CheckOtherInput(const std::vector<OutputRequest> & outputs, const std::filesystem::path & input)
{
  for (const OutputRequest & output : outputs)
  {
    if (!input.empty() && AreSameFile(output.fileName, input))
    {
      Fail(ExitStatus::Usage,
           output.fileName.string(),
           ": the ",
           output.role,
           " would replace the input ",
           input.string());
    }
  }
}

void
CheckJobFolder(const std::filesystem::path & folder, const std::vector<OutputRequest> & outputs)
{
  for (const OutputRequest & output : outputs)
  {
    const VolumeFormat * const format = GetFolderFormat(output);
    if (format && IsInside(folder, output.fileName))
    {
      Fail(ExitStatus::Usage,
           folder.string(),
           ": the folder of the job is in the ",
           format->name,
           " folder of the ",
           output.role);
    }
  }
}

} // end namespace medialvoxel
