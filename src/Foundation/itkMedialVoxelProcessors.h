// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelProcessors_h
#define itkMedialVoxelProcessors_h

#include <cstddef> // says which C library there is

// Functions that are worth a second version for processors with longer vectors, without fused operations, so that both
// have the same results. The one that runs is chosen when the library is loaded, which sanitizers cannot follow.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__) && \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#  define MEDIALVOXEL_FOR_PROCESSORS __attribute__((target_clones("avx2", "default")))
#  define MEDIALVOXEL_PART_OF_THEM __attribute__((always_inline))
#else
#  define MEDIALVOXEL_FOR_PROCESSORS
#  define MEDIALVOXEL_PART_OF_THEM
#endif

// Parts of these functions that work on vectors, which must not be passed between versions.
#if defined(__GNUC__)
#  define MEDIALVOXEL_INLINE inline __attribute__((always_inline))
#else
#  define MEDIALVOXEL_INLINE inline
#endif

#endif
