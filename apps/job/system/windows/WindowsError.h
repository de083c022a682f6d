// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWindowsError_h
#define medialvoxelWindowsError_h

#ifndef NOMINMAX
#  define NOMINMAX
#endif
#ifndef WIN32_LEAN_AND_MEAN
#  define WIN32_LEAN_AND_MEAN
#endif
#include <windows.h>

#include <filesystem>
#include <memory>
#include <string>

namespace medialvoxel
{

/** Makes errno of the last error of Windows; false. */
bool
FailWithWindowsError();

/** As FailWithWindowsError() when the call failed. */
inline bool
Check(int result)
{
  return result != 0 || FailWithWindowsError();
}

struct HandleCloser
{
  using pointer = HANDLE;
  void
  operator()(HANDLE handle) const
  {
    if (handle != INVALID_HANDLE_VALUE)
    {
      CloseHandle(handle);
    }
  }
};

/** A handle that is closed at its end; empty where none was opened. */
using WindowsHandle = std::unique_ptr<void, HandleCloser>;

} // end namespace medialvoxel

#endif
