// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FileIdentity.h"

#include "Errors.h"
#include "Progress.h"
#include "Sha256.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sys/stat.h>

namespace medialvoxel
{

FileIdentity
IdentifyFile(const std::filesystem::path & fileName)
{
  struct stat status = {};
  if (stat(fileName.c_str(), &status) != 0)
  {
    Fail(ExitStatus::Failure, "cannot read ", fileName.string(), ": ", std::strerror(errno));
  }
#ifdef __APPLE__
  const timespec & time = status.st_mtimespec;
#else
  const timespec & time = status.st_mtim;
#endif
  constexpr std::int64_t perSecond = 1000000000;
  return { fileName,
           static_cast<std::uint64_t>(status.st_size),
           static_cast<std::int64_t>(time.tv_sec) * perSecond + static_cast<std::int64_t>(time.tv_nsec),
           "" };
}

std::string
HashFile(const std::filesystem::path & fileName)
{
  constexpr std::size_t bufferBytes = std::size_t{ 1 } << 20;
  std::ifstream         file(fileName, std::ios::binary);
  std::vector<char>     buffer(bufferBytes);
  Sha256                hash;
  while (file)
  {
    if (GetStopSignal() != 0)
    {
      throw StoppedBySignal(GetStopSignal());
    }
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.Add(buffer.data(), static_cast<std::uint64_t>(file.gcount()));
  }
  if (!file.eof())
  {
    Fail(ExitStatus::Failure, "cannot read ", fileName.string(), ": ", std::strerror(errno));
  }
  return hash.Finish();
}

void
CheckUnchanged(const std::vector<FileIdentity> & files)
{
  for (const FileIdentity & file : files)
  {
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
    if (now.modified != file.modified)
    {
      Fail(ExitStatus::Failure,
           "the input ",
           file.fileName.string(),
           " has changed since the job was planned: it was written at another time");
    }
  }
}

void
CheckContent(const std::vector<FileIdentity> & files)
{
  for (const FileIdentity & file : files)
  {
    if (!file.sha256.empty() && HashFile(file.fileName) != file.sha256)
    {
      Fail(ExitStatus::Failure,
           "the input ",
           file.fileName.string(),
           " has changed since the job was planned: its content has another SHA-256");
    }
  }
}

} // end namespace medialvoxel
