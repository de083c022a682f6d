// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInputVolume_h
#define medialvoxelInputVolume_h

#include "Options.h"
#include "ValueStatistics.h"
#include "VolumeHeader.h"
#include "VolumeSource.h"

#include "itkMedialVoxelInput.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace medialvoxel
{

/** \class InputVolume
 * \brief An opened volume: the values for a run, and the time and bytes of reading. */
class InputVolume
{
public:
  /** One object.
   * \param header of a volume that ReadVolumeHeader() has checked, and UnpackVolume() has unpacked if it is compressed
   * \param bytesToKeep of chunks whose further slices are needed later, as the plan has it */
  InputVolume(const VolumeHeader & header, const JobOptions & options, std::uint64_t bytesToKeep, Smoothing smoothing);
  virtual ~InputVolume() = default;

  /** Prepares the input once, before the run reads.
   * \throw JobError CorruptInput, itk::ExceptionObject; errors of the observer */
  virtual void
  Prepare(const ReadObserver & observer)
  {
    m_Input->Prepare(observer);
  }

  /** Object, values and labels of any box. Its functions throw as Prepare(). */
  itk::MedialVoxelInput &
  GetInput() const
  {
    return *m_Input;
  }

  const VolumeSource &
  GetSource() const
  {
    return m_Source;
  }

  /** Has Prepare() find out which maximum thickness walls need in place of a default one, of the one object. */
  void
  LookForThickWalls(const itk::MedialVoxelGrid & grid, double maximum);

  /** That maximum, once Prepare() has found it; the default one, where walls need no other. */
  std::optional<double>
  GetNeededMaximum() const;

  /** How rough the object is that is not smoothed, when Prepare() measured it. */
  std::optional<itk::MedialVoxelRoughness>
  GetRoughness() const;

  /** What smoothed values are compared with, where Prepare() found it or it was given. */
  std::optional<itk::MedialVoxelSmoothingLevel>
  GetSmoothingLevel() const;

  /** Has the one object smoothed with a level that was found before. */
  void
  UseSmoothingLevel(const std::optional<itk::MedialVoxelSmoothingLevel> & level);

  /** Bytes that a part of a box takes while it is read, for each thread that reads. */
  static constexpr std::uint64_t SpanSize = std::uint64_t{ 1 } << 20;

  /** Whether several threads may read the volume; parts are then rows where a slice has more bytes. */
  static bool
  IsReadInParallel(const VolumeHeader & header);

  /** Bytes that a thread takes to smooth the object. */
  static std::uint64_t
  GetBytesToSmooth(const VolumeHeader & header);

protected:
  /** Many objects; m_Input is still to be made. */
  InputVolume(const VolumeHeader & header, std::uint64_t bytesToKeep);

  const itk::MedialVoxelObjectInput *
  GetObject() const
  {
    return dynamic_cast<const itk::MedialVoxelObjectInput *>(m_Input.get());
  }

  std::optional<double>                  m_DefaultMaximum;
  VolumeSource                           m_Source;
  std::unique_ptr<itk::MedialVoxelInput> m_Input;
};

} // end namespace medialvoxel

#endif
