// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetRemeshing_h
#define medialvoxelSheetRemeshing_h

#include "Options.h"
#include "MeshSpool.h"

#include "itkMedialVoxelRemeshedSheet.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace medialvoxel
{

/** The size of the elements, and the resources for it. */
struct SheetRemeshing
{
  itk::MedialVoxelElementSize size;
  std::filesystem::path       scratchFolder;    ///< of the result
  std::uint64_t               memoryLimit{ 0 }; ///< that may be taken
  unsigned int                threads{ 1 };
  std::function<void(double)> progress; ///< called often; may throw to stop
};

/** The size that the options ask for; it is not the size of a voxel. */
itk::MedialVoxelElementSize
GetElementSize(const ExtractOptions & options, const VolumeGeometry & geometry);

/** The sheet in elements of a size, which keep their objects together. Its parts are coarsened first; the result is
 * held in memory.
 * \param summary of the result
 * \throw JobError Refused when that is more memory than allowed, or more faces than numbers of 32 bits count */
std::unique_ptr<MeshSpool>
RemeshSheet(std::unique_ptr<MeshSpool>         surface,
            const SheetRemeshing &             remeshing,
            itk::MedialVoxelRemeshingSummary & summary);

/** Memory that it takes at least, for a number of threads. */
std::uint64_t
GetRemeshingMemory(unsigned int threads);

/** \throw JobError Usage when elements are to be smaller than the voxels */
void
CheckElementSize(const ExtractOptions & options, const VolumeGeometry & geometry);

} // end namespace medialvoxel

#endif
