// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPageFiles_h
#define medialvoxelPageFiles_h

#include <string_view>
#include <vector>

namespace medialvoxel
{

/** A file that the build has put into the program. */
struct PageFile
{
  std::string_view              name;
  std::vector<std::string_view> pieces; ///< its text, one after the other
};

/** The files of the folder page, and of the viewer library when the build found it. */
extern const std::vector<PageFile> PageFiles;

} // end namespace medialvoxel

#endif
