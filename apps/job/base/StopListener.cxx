// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "StopListener.h"

#include "Errors.h"
#include "Signals.h"

namespace medialvoxel
{

bool
StopListener::Progress::IsAborted() const
{
  return m_Sink != nullptr ? m_Sink->IsStopRequested() : GetStopSignal() != 0;
}

void
StopListener::Progress::Advance(std::uint64_t)
{}

void
StopListener::Progress::UpdateObservers()
{
  if (m_Sink != nullptr)
  {
    m_Sink->Heartbeat();
  }
}

void
StopListener::Progress::ThrowAborted() const
{
  throw StoppedBySignal(GetStopSignal());
}

} // end namespace medialvoxel
