// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSuggestName_h
#define medialvoxelSuggestName_h

#include <string>
#include <vector>

namespace medialvoxel
{

/** "; did you mean NAME?" for the name that is most like a text that is none of them; empty when none is like it. */
std::string
SuggestName(const std::string & text, const std::vector<std::string> & names);

} // end namespace medialvoxel

#endif
