// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Terminal.h"

#include <cstdlib>
#include <cstring>
#include <sys/ioctl.h>
#include <unistd.h>

namespace medialvoxel
{

void
PrepareStreams()
{}

bool
CanDrawOverLines()
{
  const char * const terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && terminal && *terminal != '\0' && std::strcmp(terminal, "dumb") != 0;
}

int
GetTerminalColumns()
{
  constexpr int usual = 80;
  winsize       size = {};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

} // end namespace medialvoxel
