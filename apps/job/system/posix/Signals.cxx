// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Signals.h"

#include <atomic>
#include <csignal>

namespace medialvoxel
{
namespace
{

/** Set by a handler, read by threads. */
std::atomic<int> stopSignal{ 0 };
static_assert(std::atomic<int>::is_always_lock_free, "a handler may set it");

extern "C" void
RememberStopSignal(int signalNumber)
{
  stopSignal = signalNumber;
}

void
Handle(int signalNumber, void (*handler)(int))
{
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(signalNumber, &action, nullptr);
}

} // namespace

void
CatchSignals()
{
  Handle(SIGINT, RememberStopSignal);
  Handle(SIGTERM, RememberStopSignal);
  struct sigaction hangUp = {};
  sigaction(SIGHUP, nullptr, &hangUp);
  if (hangUp.sa_handler != SIG_IGN)
  {
    Handle(SIGHUP, RememberStopSignal);
  }
  Handle(SIGPIPE, SIG_IGN);
  Handle(SIGXFSZ, SIG_IGN);
}

int
GetStopSignal()
{
  return stopSignal;
}

} // end namespace medialvoxel
