// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ProcessIdentity.h"

#include "WindowsError.h"

#include <array>
#include <iomanip>
#include <sstream>

namespace medialvoxel
{
namespace
{

/** In ticks of 100 ns since 1601; 0 on failure. */
std::uint64_t
GetStartTime(HANDLE process)
{
  FILETIME start = {};
  FILETIME others[3] = {};
  return GetProcessTimes(process, &start, &others[0], &others[1], &others[2]) != 0
           ? (std::uint64_t{ start.dwHighDateTime } << 32 | start.dwLowDateTime)
           : 0;
}

/** Times of starts are absolute, so a process differs from all of earlier starts of the machine. */
std::string
MakeHost()
{
  std::array<char, 64> identity{};
  DWORD                size = static_cast<DWORD>(identity.size());
  if (RegGetValueA(HKEY_LOCAL_MACHINE,
                   "SOFTWARE\\Microsoft\\Cryptography",
                   "MachineGuid",
                   RRF_RT_REG_SZ | RRF_SUBKEY_WOW6464KEY,
                   nullptr,
                   identity.data(),
                   &size) != ERROR_SUCCESS)
  {
    return {};
  }
  // FNV-1a of 64 bits
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char * letter = identity.data(); *letter != '\0'; ++letter)
  {
    hash = (hash ^ static_cast<unsigned char>(*letter)) * 0x100000001b3;
  }
  std::ostringstream host;
  host << std::hex << std::setw(12) << std::setfill('0') << (hash & ((std::uint64_t{ 1 } << 48) - 1));
  return host.str();
}

} // namespace

const ProcessIdentity &
GetThisProcess()
{
  static const ProcessIdentity process{ MakeHost(),
                                        static_cast<int>(GetCurrentProcessId()),
                                        GetStartTime(GetCurrentProcess()) };
  return process;
}

bool
HasEnded(const ProcessIdentity & process)
{
  if (process.host.empty() || process.host != GetThisProcess().host || process.number <= 0)
  {
    return false;
  }
  const WindowsHandle found(
    OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION | SYNCHRONIZE, FALSE, static_cast<DWORD>(process.number)));
  if (!found)
  {
    return GetLastError() == ERROR_INVALID_PARAMETER;
  }
  // Another process may have the number now; one that ended keeps it while a handle is open.
  const std::uint64_t startTime = GetStartTime(found.get());
  return (startTime != 0 && startTime != process.startTime) || WaitForSingleObject(found.get(), 0) == WAIT_OBJECT_0;
}

std::string
GetHostName()
{
  std::array<char, 256> name{};
  DWORD                 size = static_cast<DWORD>(name.size());
  return GetComputerNameExA(ComputerNameDnsHostname, name.data(), &size) != 0 ? name.data() : "";
}

std::filesystem::path
GetProgramFile()
{
  constexpr DWORD mostLetters = 32768;
  std::wstring    name(mostLetters, L'\0');
  name.resize(GetModuleFileNameW(nullptr, name.data(), mostLetters));
  return name;
}

} // end namespace medialvoxel
