// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

namespace medialvoxel
{

void
PrepareStreams()
{}

bool
HasTerminal()
{
  return isatty(STDERR_FILENO) != 0;
}

int
GetTerminalColumns()
{
  constexpr int usual = 80;
  winsize       size = {};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

} // end namespace medialvoxel
