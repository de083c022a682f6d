// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FileNames.h"

#include "SystemFile.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>

namespace medialvoxel
{

void
FailWithErrno(ExitStatus status, const std::string & action, const std::filesystem::path & name)
{
  Fail(status, "cannot ", action, " ", name.string(), ": ", std::strerror(errno));
}

std::filesystem::path
FollowLinks(const std::filesystem::path & fileName)
{
  constexpr int         maximumLinks = 40;
  std::filesystem::path target = fileName;
  std::error_code       error;
  for (int link = 0; link < maximumLinks && std::filesystem::is_symlink(target, error); ++link)
  {
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
  }
  return target;
}

std::filesystem::path
FolderOf(const std::filesystem::path & fileName)
{
  return fileName.has_parent_path() ? fileName.parent_path() : std::filesystem::path(".");
}

std::string
MakeUniqueDigits()
{
  std::random_device  source;
  std::array<char, 9> digits{};
  std::string         text;
  for (int half = 0; half < 2; ++half)
  {
    std::snprintf(digits.data(), digits.size(), "%08x", source() & 0xffffffffu);
    text += digits.data();
  }
  return text;
}

void
SyncFile(const std::filesystem::path & file)
{
  if (!SystemFile(file, FileAccess::Read).Sync())
  {
    FailWithErrno(ExitStatus::Failure, "write to the disk", file);
  }
}

void
SyncFolder(const std::filesystem::path & folder)
{
  SystemFile(folder, FileAccess::Read).Sync();
}

} // end namespace medialvoxel
