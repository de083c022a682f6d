// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTemporaryName_h
#define medialvoxelTemporaryName_h

#include "ProcessIdentity.h"

#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>

namespace medialvoxel
{

/** Attempts at a name that nothing has. */
constexpr int MaximumTemporaryNames = 1000;

/** The name beside \a fileName that a file or folder has while this process writes it; it tells the process, see
 * RemoveLeftovers(). A long name is cut, so that the file system takes it. */
std::filesystem::path
MakeTemporaryName(const std::filesystem::path & fileName, int attempt);

/** What a temporary name tells. */
struct TemporaryName
{
  std::string     fileName; ///< that the file was to get, or one that it belongs to
  ProcessIdentity process;
};

/** Nothing for names that MakeTemporaryName() does not give. */
std::optional<TemporaryName>
ParseTemporaryName(const std::string & name);

/** Opens a new file that no folder lists, which vanishes with the process however that ends.
 * \return the descriptor, or -1 with errno, which is EOPNOTSUPP or EISDIR where the file system has no such files */
int
OpenNamelessFile(const std::filesystem::path & folder, mode_t mode);

/** The name of an open file by which this process opens it again or gives it another name. */
std::string
GetDescriptorName(int descriptor);

/** Gives an open file without a name one that no file has. \return 0, or -1 with errno */
int
LinkNamelessFile(int descriptor, const std::filesystem::path & name);

} // end namespace medialvoxel

#endif
