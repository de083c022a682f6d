// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelProgress.h"

namespace itk
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds BeatInterval{ 100 };

thread_local MedialVoxelProgress * watchingProgress = nullptr;
thread_local Clock::time_point     nextBeat;

/** Calls Beat(), in which observers may run work of their own; that must not be stopped or watched for this one. */
void
BeatUnwatched(MedialVoxelProgress & progress)
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
      nextBeat = Clock::now() + BeatInterval;
    }
  };
  const Restorer restorer(progress);
  progress.Beat();
}

} // namespace

MedialVoxelAborted::MedialVoxelAborted()
  : std::runtime_error("The work was aborted.")
{}

MedialVoxelProgress::~MedialVoxelProgress() = default;

void
MedialVoxelProgress::Beat()
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

MedialVoxelPollScope::MedialVoxelPollScope(MedialVoxelProgress & progress)
  : m_OuterProgress(watchingProgress)
  , m_OuterNextBeat(nextBeat)
{
  watchingProgress = &progress;
  nextBeat = Clock::now() + BeatInterval;
}

MedialVoxelPollScope::~MedialVoxelPollScope()
{
  watchingProgress = m_OuterProgress;
  nextBeat = m_OuterNextBeat;
}

void
MedialVoxelPoll()
{
  MedialVoxelProgress * const progress = watchingProgress;
  if (progress == nullptr)
  {
    return;
  }
  if (!progress->IsAborted() && Clock::now() >= nextBeat)
  {
    BeatUnwatched(*progress);
  }
  if (progress->IsAborted())
  {
    progress->ThrowAborted();
  }
}

} // end namespace itk
