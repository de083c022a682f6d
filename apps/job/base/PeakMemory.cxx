// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PeakMemory.h"

#include "Text.h"

#include <fstream>
#include <string>
#include <vector>

namespace medialvoxel
{

std::uint64_t
GetPeakMemoryBytes()
{
  std::ifstream status("/proc/self/status");
  std::string   line;
  while (std::getline(status, line))
  {
    const std::vector<std::string> parts = SplitAtBlanks(line);
    if (parts.size() >= 2 && parts[0] == "VmHWM:")
    {
      return static_cast<std::uint64_t>(ParseInteger(parts[1]).value_or(0)) * 1024;
    }
  }
  return 0;
}

} // end namespace medialvoxel
