// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionDetails_h
#define medialvoxelOptionDetails_h

#include <string>
#include <vector>

namespace medialvoxel
{

/** More about an option than the line of the help has room for: for manual pages and the reference. */
struct OptionDetails
{
  const char * command; ///< empty: any with this option, unless another row names the command
  const char * option;
  const char * text; ///< sentences
};

/** All rows. */
const std::vector<OptionDetails> &
ListOptionDetails();

/** Empty when there is no more to say. */
std::string
GetOptionDetails(const std::string & command, const std::string & option);

} // end namespace medialvoxel

#endif
