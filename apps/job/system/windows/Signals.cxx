// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Signals.h"

#include "WindowsError.h"

#include <atomic>
#include <csignal>
#include <cstdlib>

namespace medialvoxel
{
namespace
{

std::atomic<int> stopSignal{ 0 };

/** Called in a thread of its own. */
BOOL WINAPI
RememberStop(DWORD event)
{
  stopSignal = event == CTRL_C_EVENT ? SIGINT : SIGTERM;
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT)
  {
    // A window closes, or a session: the process ends with the return, or after seconds.
    Sleep(INFINITE);
  }
  return TRUE;
}

} // namespace

void
CatchSignals()
{
  // A process that a group of its own was made for begins without Ctrl-C.
  SetConsoleCtrlHandler(nullptr, FALSE);
  SetConsoleCtrlHandler(RememberStop, TRUE);
  // No dialog for an abort or a missing disk.
  SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
#if defined(_MSC_VER) || defined(_UCRT)
  _set_abort_behavior(0, _WRITE_ABORT_MSG | _CALL_REPORTFAULT);
#endif
}

int
GetStopSignal()
{
  return stopSignal;
}

} // end namespace medialvoxel
