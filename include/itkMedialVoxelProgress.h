// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelProgress_h
#define itkMedialVoxelProgress_h

#include "MedialVoxelExport.h"

#include <chrono>
#include <cstdint>
#include <stdexcept>

namespace itk
{

/** \class MedialVoxelAborted
 * \brief Ends work that nobody wants any more, unless its progress throws something else.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelAborted : public std::runtime_error
{
public:
  MedialVoxelAborted();
};

/** \class MedialVoxelProgress
 * \brief What long work asks and tells, from any thread.
 *
 * Kernels call MedialVoxelCheckAbort() in each loop that can be long; a MedialVoxelProgressScope says whom that asks.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelProgress
{
public:
  virtual ~MedialVoxelProgress();

  /** True when the work is to stop as soon as possible; its results are then discarded. Takes a few nanoseconds. */
  virtual bool
  IsAborted() const = 0;

  /** \a voxels more of the requested region are done. */
  virtual void
  Advance(std::uint64_t voxels) = 0;

  /** A sign of life of a thread, ten times a second while it polls. May call observers; does nothing by default. */
  virtual void
  UpdateObservers();

  /** Throws what ends aborted work, by default MedialVoxelAborted. */
  [[noreturn]] virtual void
  ThrowAborted() const;
};

/** \class MedialVoxelNoProgress
 * \brief For work that nobody watches or stops.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelNoProgress : public MedialVoxelProgress
{
public:
  bool
  IsAborted() const override;

  void
  Advance(std::uint64_t voxels) override;
};

/** \class MedialVoxelProgressScope
 * \brief Names the progress that MedialVoxelCheckAbort() asks in this thread until the end of the scope.
 *
 * An inner scope hides an outer one.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelProgressScope
{
public:
  /** \a progress must outlive the scope. */
  explicit MedialVoxelProgressScope(MedialVoxelProgress & progress);
  ~MedialVoxelProgressScope();

  MedialVoxelProgressScope(const MedialVoxelProgressScope &) = delete;
  MedialVoxelProgressScope &
  operator=(const MedialVoxelProgressScope &) = delete;

private:
  MedialVoxelProgress *                 m_OuterProgress;
  std::chrono::steady_clock::time_point m_OuterNextUpdate;
};

/** Asks the progress of this thread whether to go on, and gives it a sign of life when a tenth of a second has passed.
 * Takes some tens of nanoseconds. Without a scope it does nothing. Throws what the progress throws when it is aborted.
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT void
MedialVoxelCheckAbort();

/** \class MedialVoxelAbortChecker
 * \brief Polls now and then in a loop whose steps are too short to poll in each.
 * \ingroup MedialVoxel
 */
class MedialVoxelAbortChecker
{
public:
  /** Steps between two polls. At a tenth of a microsecond for each step, half a millisecond passes. */
  static constexpr std::uint32_t StepsPerCheck = 4096;

  void
  Count(const std::uint32_t steps = 1)
  {
    m_Steps += steps;
    if (m_Steps >= StepsPerCheck)
    {
      m_Steps = 0;
      MedialVoxelCheckAbort();
    }
  }

private:
  std::uint32_t m_Steps{ 0 };
};

} // end namespace itk

#endif
