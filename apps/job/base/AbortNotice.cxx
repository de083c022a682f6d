// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "AbortNotice.h"

#include "itkMedialVoxelHeaderText.h"

#include <cassert>
#include <csignal>
#include <cstddef>
#include <mutex>

#include <unistd.h>

namespace medialvoxel
{
namespace
{

/** What a handler of signals may read: no object with a constructor. */
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
  _exit(written < 0 ? static_cast<int>(ExitStatus::Failure) : notice.status);
}

} // namespace

AbortNotice::AbortNotice(const ExitStatus status, const std::string & text)
  : m_Line(GetName() + ": " + itk::MedialVoxelText::MakePrintable(text) + "\n")
{
  static std::once_flag isInstalled;
  std::call_once(isInstalled, [] { std::signal(SIGABRT, WriteNotice); });
  assert(notice.line == nullptr);
  notice = { static_cast<int>(status), m_Line.c_str(), m_Line.size() };
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
