// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeSource_h
#define medialvoxelVolumeSource_h

#include "ValueReader.h"

#include "itkMedialVoxelValueSource.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace medialvoxel
{

/** \class VolumeSource
 * \brief The values of an opened volume. Each thread that asks for some has a reader of its own. */
class VolumeSource : public itk::MedialVoxelValueSource
{
public:
  /** Arguments as of MakeValueReader(). */
  VolumeSource(const VolumeHeader & header, Interpolation interpolation, std::uint64_t bytesToKeep);
  ~VolumeSource() override;

  itk::MedialVoxelValueType
  GetValueType() const override;

  /** Resampling has threads of its own. */
  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override;

  std::int64_t
  GetRowsReadTogether() const override;

  std::int64_t
  GetSlicesReadTogether() const override;

  void
  WithBox(const itk::MedialVoxelBox & box, const ViewFunction & function) override;

  void
  ForEachSpan(const itk::MedialVoxelBox & box, const SpanFunction & function) override;

  Boxes
  CutIntoSpans(const itk::MedialVoxelBox & box, std::size_t bytesPerVoxel) const override;

  void
  ForEach(const Boxes & boxes, unsigned int mostThreads, const Work & work) override;

  /** Bytes read from the file so far. */
  std::uint64_t
  GetNumberOfBytesRead() const;

  /** Seconds that all threads together spent in reading so far. */
  double
  GetReadSeconds() const
  {
    return m_ReadSeconds.load();
  }

private:
  class Lease;

  /** Calls function() and adds its time to the seconds of reading. */
  template <typename TFunction>
  void
  MeasureReading(TFunction && function);

  VolumeHeader                              m_Header;
  std::atomic<double>                       m_ReadSeconds{ 0.0 };
  std::mutex                                m_Mutex; // of the members below
  std::vector<std::unique_ptr<ValueReader>> m_Readers;
  std::vector<ValueReader *>                m_FreeReaders;
};

} // end namespace medialvoxel

#endif
