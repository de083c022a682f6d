// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MemoryPacking.h"

#include "Errors.h"

#ifdef MEDIALVOXEL_WITH_BLOSC
#  include <blosc.h>
#endif

#include <cstring>

namespace medialvoxel
{

#ifdef MEDIALVOXEL_WITH_BLOSC

std::vector<char>
PackInMemory(const std::vector<char> & values, std::uint64_t valueSize, std::vector<char> & workspace)
{
  constexpr int fastest = 1;
  constexpr int blockSize = 1 << 16; // a part is unpacked in whole blocks
  workspace.resize(values.size() + BLOSC_MAX_OVERHEAD);
  const int bytes = blosc_compress_ctx(fastest,
                                       BLOSC_SHUFFLE,
                                       valueSize,
                                       values.size(),
                                       values.data(),
                                       workspace.data(),
                                       workspace.size(),
                                       BLOSC_LZ4_COMPNAME,
                                       blockSize,
                                       1);
  if (bytes <= 0)
  {
    Fail(ExitStatus::Failure, "cannot pack ", values.size(), " bytes in memory");
  }
  return { workspace.begin(), workspace.begin() + bytes };
}

void
UnpackFromMemory(const std::vector<char> & packed,
                 std::uint64_t             valueSize,
                 std::uint64_t             first,
                 std::uint64_t             count,
                 char *                    target)
{
  const int bytes = blosc_getitem(packed.data(), static_cast<int>(first), static_cast<int>(count), target);
  if (bytes < 0 || static_cast<std::uint64_t>(bytes) != count * valueSize)
  {
    Fail(ExitStatus::Failure, "cannot unpack what was packed in memory");
  }
}

#else

std::vector<char>
PackInMemory(const std::vector<char> & values, std::uint64_t, std::vector<char> &)
{
  return values;
}

void
UnpackFromMemory(const std::vector<char> & packed,
                 std::uint64_t             valueSize,
                 std::uint64_t             first,
                 std::uint64_t             count,
                 char *                    target)
{
  std::memcpy(target, packed.data() + first * valueSize, count * valueSize);
}

#endif

} // end namespace medialvoxel
