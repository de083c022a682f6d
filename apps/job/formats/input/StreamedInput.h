// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelStreamedInput_h
#define medialvoxelStreamedInput_h

#include "InputVolume.h"
#include "ReaderPool.h"

namespace medialvoxel
{

/** Between labels there are no values: not without a threshold, and not with one value for both. A label has no
 * thresholds. */
Interpolation
GetInterpolation(const JobOptions & options);

/** \class StreamedInput
 * \brief Reads the boxes that it is asked for, each thread with a reader of its own. */
class StreamedInput : public InputVolume
{
public:
  /** \param bytesToKeep as of MakeValueReader() */
  StreamedInput(const VolumeHeader & header, const JobOptions & options, std::uint64_t bytesToKeep);

  /** Resampling has threads of its own. */
  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override;

  std::int64_t
  GetRowsReadTogether() const override
  {
    return m_Readers.GetRowsReadTogether();
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Readers.GetNumberOfBytesRead();
  }

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override;

protected:
  const VolumeHeader &
  GetHeader() const
  {
    return m_Header;
  }

  const JobOptions &
  GetOptions() const
  {
    return m_Options;
  }

  ReaderPool &
  GetReaders()
  {
    return m_Readers;
  }

private:
  VolumeHeader m_Header;
  JobOptions   m_Options;
  ReaderPool   m_Readers;
};

} // end namespace medialvoxel

#endif
