// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ProcessIdentity.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <optional>
#include <sstream>
#include <unistd.h>
#ifdef __APPLE__
#  include <climits>
#  include <mach-o/dyld.h>
#endif

namespace medialvoxel
{
namespace
{

/** Empty for missing files, also when a process ends between opening and reading; an iterator would throw then. */
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

/** The state of a process that this one may see. */
std::optional<ProcessState>
ReadState(int number)
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

/** The number of a name space that this process is in; 0 where the system does not tell. */
std::uint64_t
GetNameSpace(const char * kind)
{
  std::error_code   error;
  const std::string link = std::filesystem::read_symlink(std::string("/proc/self/ns/") + kind, error).string();
  return std::strtoull(link.c_str() + std::min(link.size(), link.find('[') + 1), nullptr, 10);
}

/** Numbers of processes mean something in one name space of one start of one machine. The digits of a start are random,
 * and numbers of name spaces differ in their low 16 bits. */
std::string
MakeHost()
{
  constexpr std::size_t firstDash = 8;
  std::string           start = ReadSmallFile("/proc/sys/kernel/random/boot_id");
  if (start.find_first_not_of("0123456789abcdef") != firstDash)
  {
    return {};
  }
  start.erase(firstDash, 1);
  constexpr std::uint64_t mask = (std::uint64_t{ 1 } << 48) - 1;
  const std::uint64_t     spaces = GetNameSpace("pid") << 16 ^ GetNameSpace("time");
  std::ostringstream      host;
  host << std::hex << std::setw(12) << std::setfill('0')
       << ((std::stoull(start.substr(0, 12), nullptr, 16) ^ spaces) & mask);
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

std::string
GetHostName()
{
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::filesystem::path
GetProgramFile()
{
#ifdef __APPLE__
  std::array<char, PATH_MAX> name{};
  auto                       size = static_cast<std::uint32_t>(name.size());
  return _NSGetExecutablePath(name.data(), &size) == 0 ? name.data() : "";
#else
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
#endif
}

} // end namespace medialvoxel
