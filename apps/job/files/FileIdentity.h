// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFileIdentity_h
#define medialvoxelFileIdentity_h

#include <cstdint>
#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** Identifies a file, or a folder with all files in it, as the one that a job began with. */
struct FileIdentity
{
  std::filesystem::path fileName;
  std::uint64_t         numberOfBytes{ 0 }; ///< of all files
  std::int64_t          modified{ 0 };      ///< the last one, in nanoseconds since 1970
};

/** Size and time of a file or folder, without reading it. \throw JobError Failure when it cannot be found. */
FileIdentity
IdentifyFile(const std::filesystem::path & name);

/** Compares size and time of the files with the recorded ones. A time with fewer digits, as another machine may see
 * it, is the same. \throw JobError Failure that names the difference. */
void
CheckUnchanged(const std::vector<FileIdentity> & files);

} // end namespace medialvoxel

#endif
