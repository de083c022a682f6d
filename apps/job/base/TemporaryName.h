// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTemporaryName_h
#define medialvoxelTemporaryName_h

#include "ProcessIdentity.h"

#include <filesystem>
#include <optional>
#include <string>

namespace medialvoxel
{

/** Attempts at a name that nothing has. */
constexpr int MaximumTemporaryNames = 1000;

/** The name beside \a fileName while this process writes the file. It names the process, see RemoveLeftovers(). A
 * long name is cut, so that the file system takes it. */
std::filesystem::path
MakeTemporaryName(const std::filesystem::path & fileName, int attempt);

/** The parts of a temporary name. */
struct TemporaryName
{
  std::string     fileName; ///< that the file was to get, or one that it belongs to
  ProcessIdentity process;
};

/** Nothing for names that MakeTemporaryName() does not give. */
std::optional<TemporaryName>
ParseTemporaryName(const std::string & name);

} // end namespace medialvoxel

#endif
