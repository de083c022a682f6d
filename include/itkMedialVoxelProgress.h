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
 * \brief Ends aborted work, unless its progress throws something else.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelAborted : public std::runtime_error
{
public:
  MedialVoxelAborted();
};

/** \class MedialVoxelProgress
 * \brief Lets users abort long work and watch it, from any thread.
 *
 * Kernels call MedialVoxelCheckAbort() in each loop that can be long; it asks the progress of the
 * MedialVoxelProgressScope.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelProgress
{
public:
  virtual ~MedialVoxelProgress();

  /** True when the work shall end as soon as possible; its results are then discarded. Takes a few nanoseconds. */
  virtual bool
  IsAborted() const = 0;

  /** \a voxels more of the requested region are done. */
  virtual void
  Advance(std::uint64_t voxels) = 0;

  /** Called ten times a second by a thread that checks for an abort. May call observers; does nothing by default. */
  virtual void
  UpdateObservers();

  /** Throws the exception of aborted work, by default MedialVoxelAborted. */
  [[noreturn]] virtual void
  ThrowAborted() const;
};

/** \class MedialVoxelNoProgress
 * \brief For work without observers or abort.
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
 * \brief Sets the progress that MedialVoxelCheckAbort() asks in this thread until the end of the scope.
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

/** Throws when the progress of this thread is aborted; updates its observers when a tenth of a second has passed. Takes
 * some tens of nanoseconds. Without a scope it does nothing.
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT void
MedialVoxelCheckAbort();

/** \class MedialVoxelAbortChecker
 * \brief Checks for an abort now and then, in loops whose steps are too short for a check each.
 * \ingroup MedialVoxel
 */
class MedialVoxelAbortChecker
{
public:
  /** Steps between two checks: half a millisecond at a tenth of a microsecond for each step. */
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
