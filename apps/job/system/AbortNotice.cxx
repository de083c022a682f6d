// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "AbortNotice.h"

#include "itkMedialVoxelHeaderText.h"

#include <cassert>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#ifdef _WIN32
#  include <io.h>
#  include <process.h>
#else
#  include <unistd.h>
#endif

namespace medialvoxel
{
namespace
{

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
  constexpr int errorStream = 2;
  const auto    written = write(errorStream, notice.line, notice.length);
  _exit(written < 0 ? EXIT_FAILURE : notice.status);
}

} // namespace

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
