// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInputVolume_h
#define medialvoxelInputVolume_h

#include "VolumeHeader.h"

#include "itkImageBase.h"
#include "itkProcessObject.h"
#include "itkStreamingRawImageIO.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace medialvoxel
{

/** Hears how much of a volume was unpacked, from 0 to 1; throws to stop. */
using ReadObserver = std::function<void(double)>;

/** \class InputVolume
 * \brief An opened volume: an image of a pipeline that makes the parts it is asked for. */
class InputVolume
{
public:
  virtual ~InputVolume() = default;

  /** Does what must be done once before the first part is asked for; the image is described without it.
   * \return what was done and what it cost, as one line; empty when there was nothing to do.
   * \throw JobError CorruptInput when packed voxels are damaged or end early. */
  virtual std::string
  Prepare(const ReadObserver &)
  {
    return {};
  }

  /** True when the image has the values 0 and 1, 1 for the object, and type uint8 whatever the file has. */
  virtual bool
  IsMask() const
  {
    return false;
  }

  /** Voxels that are not a number and that the mask does not show; 0 for images that are no masks. */
  virtual std::uint64_t
  GetNumberOfNotANumberVoxels() const
  {
    return 0;
  }

  /** Bytes read from the file so far. */
  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;

  /** Seconds spent in reading so far. */
  double
  GetReadSeconds() const
  {
    return m_ReadSeconds;
  }

  /** The start of the pipeline. */
  virtual itk::ProcessObject *
  GetReader() = 0;

protected:
  /** Adds what the source takes to the seconds of reading. */
  void
  MeasureSeconds(itk::ProcessObject & source);

  double m_ReadSeconds{ 0.0 };

private:
  std::chrono::steady_clock::time_point m_Start;
};

/** What reads the parts of an uncompressed volume that ReadVolumeHeader() has checked. */
itk::StreamingRawImageIO::Pointer
MakeVoxelReader(const VolumeHeader & header);

/** \class ImageInput
 * \brief An opened volume whose pixel type and dimension are known. */
template <typename TImage>
class ImageInput : public InputVolume
{
public:
  virtual TImage *
  GetImage() = 0;
};

/** Opens an uncompressed volume that ReadVolumeHeader() has checked. */
template <typename TPixel>
std::unique_ptr<InputVolume>
OpenStreamedInput(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
