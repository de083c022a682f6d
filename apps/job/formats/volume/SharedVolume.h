// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSharedVolume_h
#define medialvoxelSharedVolume_h

#include "OutputRequest.h"
#include "VoxelOutput.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace medialvoxel
{

/** How far the publication of a job's volume is. */
struct Publication
{
  std::filesystem::path dataName;          ///< of the voxels in formats of two files, as FindFreeDataName() gives it
  bool                  hasBegun{ false }; ///< an interrupted one may have given it its name already

  std::filesystem::path
    replacedName{}; ///< of the voxels of a volume that is to be replaced, as FindDataFile() gives it
};

/** \class SharedVolume
 * \brief A volume that several processes write, each its clusters, under a temporary name that they know: the final one
 * with a suffix of the job. */
class SharedVolume : public VoxelOutput
{
public:
  /** Creates it, and takes its space from the disk where that is known, for other processes to open.
   * \throw JobError Refused. */
  virtual void
  CreateShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix) = 0;

  /** Removes the files of CreateShared(), if they exist. */
  virtual void
  RemoveShared(const std::string & suffix) const = 0;

  /** Opens the files of CreateShared(), to write clusters. \throw JobError Failure when they have changed. */
  virtual void
  OpenShared(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & suffix) = 0;

  /** Opens the files of CreateShared() when all clusters are written, to publish them. A previous, interrupted
   * publication may be repeated. \throw JobError Failure when they have changed. */
  virtual void
  OpenToPublish(const VolumeGeometry & geometry,
                const VoxelLayout &    layout,
                const std::string &    suffix,
                const Publication &    publication) = 0;

  /** A name for the voxels that no file has; empty in formats without a file of their own for them. */
  virtual std::filesystem::path
  FindFreeDataName() const
  {
    return {};
  }

  /** Call before the first slice of a cluster is written, also after one that was given up. */
  virtual void
  StartCluster() = 0;

  /** Checksum of the stored bytes written for the cluster. */
  virtual std::uint32_t
  GetChecksum() const = 0;

  /** The same of the stored bytes, read anew. */
  virtual std::uint32_t
  ReadChecksum(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels) const = 0;

  /** Brings the cluster to the disk. \throw JobError Failure. */
  virtual void
  Sync() = 0;
};

/** The volume for the extension of a file name. \throw JobError Usage for an extension that is not written. */
std::unique_ptr<SharedVolume>
MakeSharedVolume(const std::filesystem::path & fileName, const JobOptions & options);

} // end namespace medialvoxel

#endif
