// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValueReader_h
#define medialvoxelValueReader_h

#include "Resampling.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelGrid.h"

#include <cstdint>
#include <memory>

namespace medialvoxel
{

/** \class ValueReader
 * \brief Reads boxes of a volume that streams. */
class ValueReader
{
public:
  virtual ~ValueReader() = default;

  /** Reads the values of a box, x fastest, of the pixel type of the header, in the byte order of this machine.
   * \throw JobError CorruptInput when the file lost voxels; itk::ExceptionObject */
  virtual void
  Read(const itk::MedialVoxelBox & box, void * values) = 0;

  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;
};

/** Opens a volume that ReadVolumeHeader() has checked, or ResampleHeader() has made.
 * \param interpolation of a resampled one */
std::unique_ptr<ValueReader>
MakeValueReader(const VolumeHeader & header, Interpolation interpolation = Interpolation::Linear);

} // end namespace medialvoxel

#endif
