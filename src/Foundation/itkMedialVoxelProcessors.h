// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelProcessors_h
#define itkMedialVoxelProcessors_h

#include "MedialVoxelExport.h"

#include <atomic>

#if defined(__GNUC__)
#  define MEDIALVOXEL_INLINE inline __attribute__((always_inline))
#else
#  define MEDIALVOXEL_INLINE inline
#endif

// Compilers that can build a function for another processor. Those for Windows do not align the stack for it.
#if defined(__GNUC__) && defined(__x86_64__) && !defined(_WIN32)
#  define MEDIALVOXEL_HAS_VERSIONS
#endif

namespace itk
{

/** \class MedialVoxelProcessors
 * \brief The version of all kernels that runs. AVX2 has longer vectors; both versions have results of the same bytes.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelProcessors
{
public:
  enum class Version
  {
    Plain,
    Avx2
  };

  /** At first the best one for this processor, or Plain where the environment has MEDIALVOXEL_NO_AVX2. */
  static Version
  GetVersion()
  {
    return m_Version.load(std::memory_order_relaxed);
  }

  /** For tests. False, and without effect, where this processor or build has no such version. */
  static bool
  SetVersion(Version version);

private:
  static std::atomic<Version> m_Version;
};

/** \class MedialVoxelKernel
 * \brief A function that is worth a version for each processor.
 *
 * The function and all that it calls with vectors are MEDIALVOXEL_INLINE, so that each version has its own. No vector
 * is an argument or a result by value: versions pass them in different registers.
 * \ingroup MedialVoxel
 */
template <auto VFunction>
class MedialVoxelKernel;

template <typename TResult, typename... TArguments, TResult (*VFunction)(TArguments...)>
class MedialVoxelKernel<VFunction>
{
public:
#if defined(MEDIALVOXEL_HAS_VERSIONS)
  static MEDIALVOXEL_INLINE TResult
  Run(TArguments... arguments)
  {
    return MedialVoxelProcessors::GetVersion() == MedialVoxelProcessors::Version::Avx2 ? RunAvx2(arguments...)
                                                                                       : RunPlain(arguments...);
  }

private:
  // Without fused operations, which round in another way.
  __attribute__((target("avx2"), noinline)) static TResult
  RunAvx2(TArguments... arguments)
  {
    return VFunction(arguments...);
  }

  __attribute__((noinline)) static TResult
  RunPlain(TArguments... arguments)
  {
    return VFunction(arguments...);
  }
#else
  static TResult
  Run(TArguments... arguments)
  {
    return VFunction(arguments...);
  }
#endif
};

} // end namespace itk

#endif
