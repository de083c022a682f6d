// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPageText_h
#define medialvoxelPageText_h

#include <cstdint>
#include <string>
#include <string_view>

namespace medialvoxel
{

std::string
EncodeBase64(std::string_view bytes);

/** Whether the build has put a file into the program. */
bool
HasPageFile(std::string_view name);

/** Adds its text to a page. \throw std::out_of_range when there is none */
void
AddPageFile(std::string & page, std::string_view name);

/** Its text. \throw std::out_of_range when there is none */
std::string
GetPageFile(std::string_view name);

/** Bytes of all files in the program. */
std::uint64_t
GetPageFileSize();

} // end namespace medialvoxel

#endif
