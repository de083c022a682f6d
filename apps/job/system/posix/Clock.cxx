// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Clock.h"

namespace medialvoxel
{

std::tm
GetUniversalTime(std::time_t seconds)
{
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  return parts;
}

} // end namespace medialvoxel
