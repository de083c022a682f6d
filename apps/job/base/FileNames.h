// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFileNames_h
#define medialvoxelFileNames_h

#include "Errors.h"

#include <filesystem>
#include <string>

namespace medialvoxel
{

/** Throws JobError "cannot [action] [name]: [text of errno]". */
[[noreturn]] void
FailWithErrno(ExitStatus status, const std::string & action, const std::filesystem::path & name);

/** The file that a symbolic link leads to, whether it exists or not; other names stay as they are. */
std::filesystem::path
FollowLinks(const std::filesystem::path & fileName);

/** The folder that a file is in, also of a name without one. */
std::filesystem::path
FolderOf(const std::filesystem::path & fileName);

/** 16 hexadecimal digits that no other process has. */
std::string
MakeUniqueDigits();

/** Brings the bytes of a file to the disk. \throw JobError Failure */
void
SyncFile(const std::filesystem::path & file);

/** Brings the names in a folder to the disk, where the file system can. */
void
SyncFolder(const std::filesystem::path & folder);

} // end namespace medialvoxel

#endif
