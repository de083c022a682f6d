// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelProcessors.h"

#if defined(MEDIALVOXEL_HAS_VERSIONS)
#  include <cpuid.h>
#endif

#include <cstdlib>

namespace itk
{

namespace
{

/** True when the processor has AVX2 and the system keeps its registers. Not by __builtin_cpu_supports(), which always
 * denies in the library of Zig's compiler, which builds wheels. */
bool
HasAvx2()
{
#if defined(MEDIALVOXEL_HAS_VERSIONS)
  unsigned int a = 0;
  unsigned int b = 0;
  unsigned int c = 0;
  unsigned int d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & bit_OSXSAVE) == 0 || (c & bit_AVX) == 0)
  {
    return false;
  }
  constexpr unsigned int registers = 6; // of 16 and of 32 bytes
  unsigned int           kept = 0;
  __asm__("xgetbv" : "=a"(kept), "=d"(d) : "c"(0));
  return (kept & registers) == registers && __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & bit_AVX2) != 0;
#else
  return false;
#endif
}

} // namespace

std::atomic<MedialVoxelProcessors::Version> MedialVoxelProcessors::m_Version{
  HasAvx2() && std::getenv("MEDIALVOXEL_NO_AVX2") == nullptr ? Version::Avx2 : Version::Plain
};

bool
MedialVoxelProcessors::SetVersion(const Version version)
{
  if (version == Version::Avx2 && !HasAvx2())
  {
    return false;
  }
  m_Version = version;
  return true;
}

} // end namespace itk
