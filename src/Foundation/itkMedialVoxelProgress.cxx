// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelProgress.h"

namespace itk
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds UpdateInterval{ 100 };

thread_local MedialVoxelProgress * watchingProgress = nullptr;
thread_local Clock::time_point     nextUpdate;

/** Observers may run work of their own, which this progress must neither abort nor watch. */
void
UpdateUnwatched(MedialVoxelProgress & progress)
{
  struct Restorer
  {
    MedialVoxelProgress & progress;

    explicit Restorer(MedialVoxelProgress & watching)
      : progress(watching)
    {
      watchingProgress = nullptr;
    }
    ~Restorer()
    {
      watchingProgress = &progress;
      nextUpdate = Clock::now() + UpdateInterval;
    }
  };
  const Restorer restorer(progress);
  progress.UpdateObservers();
}

} // namespace

MedialVoxelAborted::MedialVoxelAborted()
  : std::runtime_error("The work was aborted.")
{}

MedialVoxelProgress::~MedialVoxelProgress() = default;

void
MedialVoxelProgress::UpdateObservers()
{}

void
MedialVoxelProgress::ThrowAborted() const
{
  throw MedialVoxelAborted();
}

bool
MedialVoxelNoProgress::IsAborted() const
{
  return false;
}

void
MedialVoxelNoProgress::Advance(std::uint64_t)
{}

MedialVoxelProgressScope::MedialVoxelProgressScope(MedialVoxelProgress & progress)
  : m_OuterProgress(watchingProgress)
  , m_OuterNextUpdate(nextUpdate)
{
  watchingProgress = &progress;
  nextUpdate = Clock::now() + UpdateInterval;
}

MedialVoxelProgressScope::~MedialVoxelProgressScope()
{
  watchingProgress = m_OuterProgress;
  nextUpdate = m_OuterNextUpdate;
}

void
MedialVoxelCheckAbort()
{
  MedialVoxelProgress * const progress = watchingProgress;
  if (progress == nullptr)
  {
    return;
  }
  if (!progress->IsAborted() && Clock::now() >= nextUpdate)
  {
    UpdateUnwatched(*progress);
  }
  if (progress->IsAborted())
  {
    progress->ThrowAborted();
  }
}

} // end namespace itk
