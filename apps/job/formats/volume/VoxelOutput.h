// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVoxelOutput_h
#define medialvoxelVoxelOutput_h

#include "JobPlan.h"
#include "Options.h"
#include "VoxelLayout.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace medialvoxel
{

/** \class VoxelOutput
 * \brief A volume that is written in parts, from its first slice to its last, and appears only when it is complete. */
class VoxelOutput
{
public:
  virtual ~VoxelOutput() = default;

  /** Creates it under a temporary name and, unless sparse or packed, takes its space from the disk.
   * \throw JobError Refused. */
  virtual void
  Create(const VolumeGeometry & geometry, const VoxelLayout & layout) = 0;

  /** Writes a large volume past the page cache from now on, where it can; to be called after Create(). */
  virtual void
  BypassPageCacheWhenLarge()
  {}

  /** Writes voxels that follow each other, x fastest: whole slices. \throw JobError Failure. */
  virtual void
  Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data) = 0;

  /** Writes the same rows of several slices, where GetRowsOfLayer() has more than 0: multiples of it, but for the
   * last rows. The rows of a slice follow each other. A layer of slices comes with all rows before the next layer.
   * \throw JobError Failure. */
  virtual void
  WriteRows(const SliceRange & slices, const RowRange & rows, const void * data);

  /** Brings everything to the disk and compares sizes. \throw JobError Failure. */
  virtual void
  Finish() = 0;

  /** Reads back voxels that follow each other, after Finish(). */
  virtual void
  Read(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, void * data) const = 0;

  /** Reads back the voxels whose index along an axis is the second argument, x fastest, after Finish().
   * \return false where reading row by row is at least as fast; nothing was read then */
  virtual bool
  ReadPlane(unsigned int, std::uint64_t, void *) const
  {
    return false;
  }

  /** Gives it its name. */
  virtual void
  Publish() = 0;
};

/** \class VoxelReceiver
 * \brief Takes the voxels of a volume on their way, which becomes no file here. */
class VoxelReceiver : public VoxelOutput
{
public:
  void
  Create(const VolumeGeometry &, const VoxelLayout &) override
  {}
  void
  Finish() override
  {}
  void
  Read(std::uint64_t, std::uint64_t, void *) const override
  {}
  void
  Publish() override
  {}
};

/** The output for the extension of a file name. \throw JobError Usage for an extension that is not written. */
std::unique_ptr<VoxelOutput>
MakeVoxelOutput(const std::filesystem::path & fileName, const JobOptions & options);

} // end namespace medialvoxel

#endif
