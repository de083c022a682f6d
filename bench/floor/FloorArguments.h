// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef FloorArguments_h
#define FloorArguments_h

#include <array>
#include <cstdint>
#include <cstdio>
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

#endif
