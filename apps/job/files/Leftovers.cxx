// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Leftovers.h"

#include "DataFile.h"
#include "FileNames.h"
#include "SystemFile.h"
#include "TemporaryName.h"

#include <algorithm>
#include <cerrno>
#include <set>
#include <string>

namespace medialvoxel
{
namespace
{

struct Leftover
{
  std::filesystem::path path;
  std::filesystem::path owner; ///< the file that it was to become, or a header that it belongs to
};

/** The paths of all that is in a folder; none where it cannot be read. */
std::vector<std::filesystem::path>
ListFolder(const std::filesystem::path & folder)
{
  std::vector<std::filesystem::path>        paths;
  std::error_code                           error;
  std::filesystem::directory_iterator       entry(folder, error);
  const std::filesystem::directory_iterator end;
  for (; !error && entry != end; entry.increment(error))
  {
    paths.push_back(entry->path());
  }
  return paths;
}

bool
IsOurs(const std::filesystem::path & path)
{
  const auto status = GetFileStatus(path, false);
  return status && status->isOfThisUser && (status->isFile || status->isFolder);
}

std::vector<Leftover>
ListLeftovers(const std::filesystem::path & folder)
{
  std::vector<Leftover> leftovers;
  for (const std::filesystem::path & path : ListFolder(folder))
  {
    const auto name = ParseTemporaryName(path.filename().string());
    if (name && HasEnded(name->process) && IsOurs(path))
    {
      leftovers.push_back({ path, folder / name->fileName });
    }
  }
  return leftovers;
}

/** Renames a leftover to one of this process, so that no other process that starts now looks at it too. */
bool
Claim(Leftover & leftover)
{
  for (int attempt = 0; attempt < MaximumTemporaryNames; ++attempt)
  {
    const std::filesystem::path name = MakeTemporaryName(leftover.owner, attempt);
    if (Rename(leftover.path, name, TakenName::Stays))
    {
      leftover.path = name;
      return true;
    }
    if (errno != EEXIST)
    {
      return false;
    }
  }
  return false;
}

/** Removes voxels unless a header names them. */
void
RemoveOrphan(const std::filesystem::path & voxels, const std::filesystem::path & header)
{
  if (IsDataName(voxels, header) && FindDataFile(header) != voxels)
  {
    RemoveName(voxels);
  }
}

/** The process was killed between the names of the voxels and of the header, which would have taken the first from this
 * file, see OutputFile::PublishForNow(). */
void
RemoveOtherName(const Leftover & leftover)
{
  std::error_code error;
  for (const std::filesystem::path & path : ListFolder(FolderOf(leftover.owner)))
  {
    if (IsDataName(path, leftover.owner) && std::filesystem::equivalent(path, leftover.path, error))
    {
      RemoveOrphan(path, leftover.owner);
    }
  }
}

/** The process was killed after its header had replaced this one, while the voxels of this one were still there.
 * Voxels of two names belong to a process at work, or to another leftover. */
void
RemoveVoxelsOfHeader(const Leftover & leftover)
{
  const std::filesystem::path voxels = FindDataFile(leftover.owner, leftover.path);
  const auto                  status = GetFileStatus(voxels, false);
  if (status && status->isFile && status->numberOfNames == 1)
  {
    RemoveOrphan(voxels, leftover.owner);
  }
}

void
Remove(Leftover & leftover)
{
  const auto status = Claim(leftover) ? GetFileStatus(leftover.path, false) : std::nullopt;
  if (!status)
  {
    return;
  }
  if (status->isFile)
  {
    status->numberOfNames > 1 ? RemoveOtherName(leftover) : RemoveVoxelsOfHeader(leftover);
  }
  std::error_code error;
  std::filesystem::remove_all(leftover.path, error);
}

} // namespace

void
RemoveLeftovers(const std::filesystem::path & folder)
{
  std::vector<Leftover> leftovers = ListLeftovers(folder);
  std::for_each(leftovers.begin(), leftovers.end(), Remove);
}

void
RemoveLeftovers(const std::vector<OutputRequest> & outputs)
{
  std::set<std::filesystem::path> folders;
  for (const OutputRequest & output : outputs)
  {
    folders.insert(FolderOf(FollowLinks(output.fileName)));
  }
  for (const std::filesystem::path & folder : folders)
  {
    RemoveLeftovers(folder);
  }
}

} // end namespace medialvoxel
