// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FormatNames.h"

namespace medialvoxel
{

/** Names in helps of options for files, which a library of arrays alone does not show. */
std::vector<std::string>
ListInputFormats()
{
  return {};
}

std::vector<std::string>
ListOutputExtensions(unsigned int)
{
  return {};
}

} // end namespace medialvoxel
