// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelStopListener_h
#define medialvoxelStopListener_h

#include "Progress.h"

#include "itkMedialVoxelProgress.h"

#include <cstdint>

namespace medialvoxel
{

/** \class StopListener
 * \brief While it exists, itk::MedialVoxelCheckAbort() in this thread throws StoppedBySignal when the work is to stop.
 */
class StopListener
{
public:
  /** \param sink is asked and gets heartbeats; null: signals alone count */
  explicit StopListener(ProgressSink * sink = nullptr)
    : m_Progress(sink)
    , m_Scope(m_Progress)
  {}

private:
  class Progress : public itk::MedialVoxelProgress
  {
  public:
    explicit Progress(ProgressSink * sink)
      : m_Sink(sink)
    {}

    bool
    IsAborted() const override;

    void
    Advance(std::uint64_t voxels) override;

    void
    UpdateObservers() override;

    [[noreturn]] void
    ThrowAborted() const override;

  private:
    ProgressSink * m_Sink;
  };

  Progress                      m_Progress;
  itk::MedialVoxelProgressScope m_Scope;
};

} // end namespace medialvoxel

#endif
