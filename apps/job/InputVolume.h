// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInputVolume_h
#define medialvoxelInputVolume_h

#include "VolumeHeader.h"

#include "itkImageBase.h"
#include "itkProcessObject.h"

#include <cstdint>
#include <memory>

namespace medialvoxel
{

/** \class InputVolume
 * \brief An opened volume: an image of a pipeline that reads the parts it is asked for, or holds all that is packed. */
class InputVolume
{
public:
  virtual ~InputVolume() = default;

  /** Bytes read from the file so far. */
  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;

  /** Seconds spent in reading so far. */
  double
  GetReadSeconds() const
  {
    return m_ReadSeconds;
  }

  /** The start of the pipeline; null for volumes that are in memory. */
  virtual itk::ProcessObject *
  GetReader() = 0;

protected:
  double m_ReadSeconds{ 0.0 };
};

/** \class ImageInput
 * \brief An opened volume whose pixel type and dimension are known. */
template <typename TImage>
class ImageInput : public InputVolume
{
public:
  virtual TImage *
  GetImage() = 0;
};

/** Opens a volume that ReadVolumeHeader() has checked; a compressed one is unpacked into memory.
 * \throw JobError CorruptInput when packed voxels are damaged or end early. */
template <typename TPixel>
std::unique_ptr<InputVolume>
OpenInput(const VolumeHeader & header);

/** The same, for the pixel type of the header. */
std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
