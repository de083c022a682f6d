// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLogRecord_h
#define medialvoxelLogRecord_h

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** How urgent a line of a log is, the most urgent first. */
enum class LogLevel : std::uint8_t
{
  Error,
  Warning,
  Info
};

/** A step of a job: one line of a log. */
struct LogRecord
{
  LogLevel                                         level{ LogLevel::Info };
  std::string                                      event; ///< one word
  std::vector<std::pair<std::string, std::string>> values;
};

} // end namespace medialvoxel

#endif
