// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVoxelStream_h
#define medialvoxelVoxelStream_h

#include <cstdint>

namespace medialvoxel
{

/** \class VoxelStream
 * \brief The numbers of a compressed volume from front to back, in bounded memory and in the byte order of its header.
 */
class VoxelStream
{
public:
  virtual ~VoxelStream() = default;

  /** Reads exactly \a numberOfBytes. \throw JobError CorruptInput when the voxels are damaged or end early. */
  virtual void
  Read(void * destination, std::uint64_t numberOfBytes) = 0;

  /** Call after the last voxel. \throw JobError CorruptInput when the rest of the stream is damaged. */
  virtual void
  CheckEnd() = 0;

  /** Bytes read from the file so far. */
  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;
};

} // end namespace medialvoxel

#endif
