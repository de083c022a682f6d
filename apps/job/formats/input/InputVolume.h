// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInputVolume_h
#define medialvoxelInputVolume_h

#include "Options.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelObjectSource.h"
#include "itkMedialVoxelRoughness.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace medialvoxel
{

/** Hears how much of a volume was read, from 0 to 1; throws to stop. */
using ReadObserver = std::function<void(double)>;

/** Where the voxels of a box go; null: they are not wanted. */
struct VoxelTargets
{
  itk::MedialVoxelBits * object{ nullptr };     ///< clear bits; those of the object are set
  itk::MedialVoxelBits * notANumber{ nullptr }; ///< the same for values that are not a number
  itk::MedialVoxelGray * gray{ nullptr };
};

/** \class InputVolume
 * \brief An opened volume: the object bits and values of any box of it. */
class InputVolume
{
public:
  virtual ~InputVolume() = default;

  /** Does what must be done once before the first box is asked for. \throw as Fill() */
  virtual void
  Prepare(const ReadObserver &)
  {}

  /** Voxels that are not a number and that Fill() does not show. */
  virtual std::uint64_t
  GetNumberOfNotANumberVoxels() const
  {
    return 0;
  }

  /** How rough the object is that is not smoothed, when Prepare() measured it. */
  virtual std::optional<itk::MedialVoxelRoughness>
  GetRoughness() const
  {
    return std::nullopt;
  }

  /** Threads that may call Fill(). */
  virtual itk::MedialVoxelSourceThreads
  GetSourceThreads() const
  {
    return itk::MedialVoxelSourceThreads::OneAtATime;
  }

  /** Rows that are best read by one thread, in all slices of a box; 1: slices are. */
  virtual std::int64_t
  GetRowsReadTogether() const
  {
    return 1;
  }

  /** Fills what is wanted of a box, in parts between which the thread polls.
   * \throw JobError CorruptInput, itk::ExceptionObject */
  virtual void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) = 0;

  /** Bytes that a part of a box takes while it is read, for each thread that reads. */
  static constexpr std::uint64_t BytesPerPart = std::uint64_t{ 1 } << 20;

  /** Whether several threads may read the volume; parts are then rows where a slice has more bytes. */
  static bool
  IsReadInParallel(const VolumeHeader & header);

  /** Bytes read from the file so far. */
  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;

  /** Seconds that all threads together spent in reading so far. */
  double
  GetReadSeconds() const
  {
    return m_ReadSeconds.load();
  }

protected:
  /** Calls function() and adds what it takes to the seconds of reading. */
  template <typename TFunction>
  void
  MeasureReading(TFunction && function)
  {
    const auto start = std::chrono::steady_clock::now();
    function();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double       before = m_ReadSeconds.load();
    while (!m_ReadSeconds.compare_exchange_weak(before, before + seconds))
    {
    }
  }

private:
  std::atomic<double> m_ReadSeconds{ 0.0 };
};

/** Opens a volume that ReadVolumeHeader() has checked, and UnpackVolume() has unpacked if it is compressed.
 * \param bytesToKeep of chunks whose further slices are needed later, as the plan has it
 * \param smoothing of the object */
std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header,
                const JobOptions &   options,
                std::uint64_t        bytesToKeep = 0,
                Smoothing            smoothing = Smoothing::Off);

} // end namespace medialvoxel

#endif
