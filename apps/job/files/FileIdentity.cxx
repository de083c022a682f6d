// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FileIdentity.h"

#include "FileNames.h"
#include "SystemFile.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** The file itself, or all files in a folder, in order. */
std::vector<std::filesystem::path>
ListFiles(const std::filesystem::path & name)
{
  std::error_code error;
  if (!std::filesystem::is_directory(name, error))
  {
    return { name };
  }
  std::vector<std::filesystem::path> files;
  for (std::filesystem::recursive_directory_iterator entry(name, error), end; !error && entry != end;)
  {
    itk::MedialVoxelCheckAbort();
    if (!entry->is_directory(error))
    {
      files.push_back(entry->path());
    }
    entry.increment(error);
  }
  if (error)
  {
    Fail(ExitStatus::Failure, "cannot read ", name.string(), ": ", error.message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/** True when both may be the time of one file: some file systems of networks keep less than the disk behind them does,
 * in whole seconds, microseconds or units of 100 ns, rounded down. */
bool
IsSameTime(std::int64_t a, std::int64_t b)
{
  const auto [early, late] = std::minmax(a, b);
  for (const std::int64_t unit : { 1, 100, 1000, 1000000000 })
  {
    if (early % unit == 0 && late - early < unit)
    {
      return true;
    }
  }
  return false;
}

} // namespace

FileIdentity
IdentifyFile(const std::filesystem::path & name)
{
  FileIdentity identity{ name, 0, 0 };
  for (const std::filesystem::path & file : ListFiles(name))
  {
    itk::MedialVoxelCheckAbort();
    const auto status = GetFileStatus(file);
    if (!status)
    {
      FailWithErrno(ExitStatus::Failure, "read", file);
    }
    identity.numberOfBytes += status->numberOfBytes;
    identity.modified = std::max(identity.modified, status->modified);
  }
  return identity;
}

void
CheckUnchanged(const std::vector<FileIdentity> & files)
{
  for (const FileIdentity & file : files)
  {
    std::error_code error;
    if (!std::filesystem::exists(file.fileName, error))
    {
      Fail(ExitStatus::Failure,
           "the input ",
           std::filesystem::absolute(file.fileName).lexically_normal().string(),
           " of the job is gone: ",
           error ? error.message() : "No such file or directory",
           "; put it back, or plan the job again with its new place");
    }
    const FileIdentity now = IdentifyFile(file.fileName);
    if (now.numberOfBytes != file.numberOfBytes)
    {
      Fail(ExitStatus::Failure,
           "the input ",
           file.fileName.string(),
           " has changed since the job was planned: it has ",
           now.numberOfBytes,
           " bytes, it had ",
           file.numberOfBytes);
    }
    if (!IsSameTime(now.modified, file.modified))
    {
      Fail(ExitStatus::Failure,
           "the input ",
           file.fileName.string(),
           " has changed since the job was planned: it was written at another time");
    }
  }
}

} // end namespace medialvoxel
