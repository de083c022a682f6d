// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Signals.h"

#include <csignal>

namespace medialvoxel
{
namespace
{

volatile std::sig_atomic_t stopSignal = 0;

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
