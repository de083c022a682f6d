// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVoxelSource_h
#define medialvoxelVoxelSource_h

#include "VolumeHeader.h"

#include <cstdint>
#include <memory>

namespace medialvoxel
{

/** \class VoxelSource
 * \brief The numbers of a compressed volume, as they are stored but in the byte order of this machine. */
class VoxelSource
{
public:
  virtual ~VoxelSource() = default;

  /** \param offset in bytes, from the first voxel
   * \throw JobError CorruptInput when the voxels are damaged or end early, and with the last one when more follow */
  virtual void
  Read(std::uint64_t offset, void * destination, std::uint64_t numberOfBytes) = 0;

  /** Bytes read from the file so far. */
  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;
};

/** Unpacks while it is read, in bounded memory: each call of Read() goes on where the one before ended. */
std::shared_ptr<VoxelSource>
OpenVoxelSource(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
