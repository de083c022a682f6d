// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef FloorSupport_h
#define FloorSupport_h

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

/** X,Y,Z with positive numbers.
 *  \exception std::invalid_argument on anything else. */
inline std::array<std::int64_t, 3>
ParseSize(const std::string & text)
{
  std::array<std::int64_t, 3> size{};
  std::istringstream          stream(text);
  char                        firstComma = 0, secondComma = 0;
  if (!(stream >> size[0] >> firstComma >> size[1] >> secondComma >> size[2]) || firstComma != ',' ||
      secondComma != ',' || stream.peek() != EOF || size[0] < 1 || size[1] < 1 || size[2] < 1)
  {
    throw std::invalid_argument(text + ": expected a size X,Y,Z of positive numbers");
  }
  return size;
}

inline double
SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/** Largest resident memory of this program; of /proc, because getrusage() counts what the caller had before exec(). */
inline std::int64_t
GetPeakMemory()
{
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;)
  {
    if (key == "VmHWM:")
    {
      std::int64_t kibibytes = 0;
      status >> kibibytes;
      return kibibytes * 1024;
    }
  }
  return 0;
}

#endif
