// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Terminal.h"

#include "WindowsError.h"

#include <fcntl.h>
#include <io.h>

namespace medialvoxel
{

void
PrepareStreams()
{
  for (const int stream : { 0, 1, 2 })
  {
    _setmode(stream, _O_BINARY);
  }
  SetConsoleOutputCP(CP_UTF8);
}

bool
CanDrawOverLines()
{
  const HANDLE stream = GetStdHandle(STD_ERROR_HANDLE);
  DWORD        mode = 0;
  return GetConsoleMode(stream, &mode) != 0 && SetConsoleMode(stream, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

int
GetTerminalColumns()
{
  constexpr int              usual = 80;
  CONSOLE_SCREEN_BUFFER_INFO buffer = {};
  return GetConsoleScreenBufferInfo(GetStdHandle(STD_ERROR_HANDLE), &buffer) != 0
           ? buffer.srWindow.Right - buffer.srWindow.Left + 1
           : usual;
}

} // end namespace medialvoxel
