// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ProcessIdentity.h"

#include "Checksum.h"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <optional>
#include <sstream>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

/** Empty for what is gone, also when a process ends between opening and reading, which an iterator would throw. */
std::string
ReadSmallFile(const std::filesystem::path & fileName)
{
  std::ifstream      file(fileName, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct ProcessState
{
  char          letter{ '?' };
  std::uint64_t startTime{ 0 };
};

/** Of a process that this one may see. */
std::optional<ProcessState>
ReadState(pid_t number)
{
  const std::string text = ReadSmallFile("/proc/" + std::to_string(number) + "/stat");
  // The name of the program, in brackets, may have blanks and brackets.
  const std::size_t bracket = text.rfind(')');
  if (bracket == std::string::npos)
  {
    return std::nullopt;
  }
  std::istringstream fields(text.substr(bracket + 1));
  ProcessState       state;
  fields >> state.letter;
  constexpr int fieldsBetween = 18;
  std::string   ignored;
  for (int field = 0; field < fieldsBetween; ++field)
  {
    fields >> ignored;
  }
  fields >> state.startTime;
  return fields ? std::optional<ProcessState>(state) : std::nullopt;
}

/** Numbers of processes mean something in one name space of one start of one machine. Machines are many, so the digits
 * of their starts, which are random, add to the checksum of all three. */
std::string
MakeHost()
{
  constexpr std::size_t digitsOfStart = 4;
  constexpr std::size_t firstDash = 8;
  std::string           text = ReadSmallFile("/proc/sys/kernel/random/boot_id");
  if (text.find_first_not_of("0123456789abcdef") != firstDash)
  {
    return {};
  }
  std::ostringstream host;
  host << text.substr(0, digitsOfStart);
  for (const char * const space : { "/proc/self/ns/pid", "/proc/self/ns/time" })
  {
    std::error_code error;
    text += std::filesystem::read_symlink(space, error).string() + "\n";
  }
  host << std::hex << std::setw(8) << std::setfill('0') << GetChecksum(text);
  return host.str();
}

ProcessIdentity
MakeThisProcess()
{
  ProcessIdentity process;
  process.number = getpid();
  if (const auto state = ReadState(process.number))
  {
    process.startTime = state->startTime;
    process.host = MakeHost();
  }
  return process;
}

} // namespace

const ProcessIdentity &
GetThisProcess()
{
  static const ProcessIdentity process = MakeThisProcess();
  return process;
}

bool
HasEnded(const ProcessIdentity & process)
{
  if (process.host.empty() || process.host != GetThisProcess().host || process.number <= 0)
  {
    return false;
  }
  if (kill(process.number, 0) != 0 && errno == ESRCH)
  {
    return true;
  }
  const auto state = ReadState(process.number);
  // Another process may have the number now; of one that was killed, its parent may not have been told yet.
  return state && (state->startTime != process.startTime || state->letter == 'Z' || state->letter == 'X');
}

} // end namespace medialvoxel
