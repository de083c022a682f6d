// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValueReader_h
#define medialvoxelValueReader_h

#include "Resampling.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelValues.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace medialvoxel
{

using ValueView = itk::MedialVoxelValueView;

/** \class ValueReader
 * \brief Reads boxes of a volume. */
class ValueReader
{
public:
  using SpanFunction = std::function<void(const itk::MedialVoxelBox &)>;

  virtual ~ValueReader() = default;

  /** Reads the values of a box, x fastest, of the value type of the header, in the byte order of this machine.
   * \throw JobError CorruptInput when the file lost voxels; itk::ExceptionObject */
  virtual void
  Read(const itk::MedialVoxelBox & box, void * values) = 0;

  /** Calls function(part) for parts of a box that are best read each by itself. */
  virtual void
  ForEachSpan(const itk::MedialVoxelBox & box, const SpanFunction & function) const = 0;

  /** Rows that are best read by one thread, in all slices of a box; 1: slices are. */
  virtual std::int64_t
  GetRowsReadTogether() const
  {
    return 1;
  }

  /** Reads the values of a part that ForEachSpan() gave, and keeps them until the next call. \throw as Read() */
  virtual ValueView
  Look(const itk::MedialVoxelBox & part) = 0;

  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;

  /** A reader of the same volume, for another thread. */
  virtual std::unique_ptr<ValueReader>
  MakeAnother() const = 0;
};

/** Parts of a box of about a megabyte: whole slices, or rows of large slices where that is better. */
std::vector<itk::MedialVoxelBox>
CutIntoSpans(const itk::MedialVoxelBox & box, std::size_t bytesPerVoxel, bool takesRows);

/** Opens a volume that ReadVolumeHeader() has checked, or ResampleHeader() has made. Reads a compressed one from
 * front to back unless UnpackVolume() has unpacked it.
 * \param interpolation of a resampled volume
 * \param bytesToKeep of chunks whose further slices are needed later, for volumes in chunks */
std::unique_ptr<ValueReader>
MakeValueReader(const VolumeHeader & header,
                Interpolation        interpolation = Interpolation::Linear,
                std::uint64_t        bytesToKeep = 0);

} // end namespace medialvoxel

#endif
