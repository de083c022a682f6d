// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Version.h"

namespace medialvoxel
{

std::string
GetVersion()
{
  return MEDIALVOXEL_VERSION;
}

} // end namespace medialvoxel
