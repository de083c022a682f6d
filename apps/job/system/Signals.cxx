// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Signals.h"

#include "itkMedialVoxelHeaderText.h"

#include <cassert>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <unistd.h>

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

/** The state that a handler of signals may read: no object with a constructor. */
struct Notice
{
  int          status;
  const char * line;
  std::size_t  length;
};

thread_local Notice notice{};

std::string &
GetName()
{
  static std::string name = "medialvoxel";
  return name;
}

/** A thread without a notice lets the process end as it would have. */
extern "C" void
WriteNotice(int)
{
  if (notice.line == nullptr)
  {
    std::signal(SIGABRT, SIG_DFL);
    return;
  }
  const ssize_t written = write(STDERR_FILENO, notice.line, notice.length);
  _exit(written < 0 ? EXIT_FAILURE : notice.status);
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

AbortNotice::AbortNotice(int status, const std::string & text)
  : m_Line(GetName() + ": " + itk::MedialVoxelText::MakePrintable(text) + "\n")
{
  static std::once_flag isInstalled;
  std::call_once(isInstalled, [] { std::signal(SIGABRT, WriteNotice); });
  assert(notice.line == nullptr);
  notice = { status, m_Line.c_str(), m_Line.size() };
}

AbortNotice::~AbortNotice()
{
  notice = {};
}

void
SetNameForAborts(const std::string & programName)
{
  GetName() = programName;
}

} // end namespace medialvoxel
