// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOtherNames_h
#define medialvoxelOtherNames_h

#include <string>
#include <vector>

namespace medialvoxel
{

/** Why a command has no option of this name: the name of today, the name that other programs use for it, or a similar
 * one of \a names. */
std::string
DescribeUnknownOption(const std::string & name, const std::string & command, const std::vector<std::string> & names);

} // end namespace medialvoxel

#endif
