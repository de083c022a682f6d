// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionValues.h"

namespace medialvoxel
{

std::optional<bool>
ParseFlag(const std::string & text)
{
  const std::string name = ToLower(text);
  const auto        isOneOf = [&name](std::initializer_list<const char *> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (isOneOf({ "true", "on", "yes", "1" }))
  {
    return true;
  }
  return isOneOf({ "false", "off", "no", "0" }) ? std::optional<bool>(false) : std::nullopt;
}

std::vector<std::string>
SplitAtCommas(const std::string & text)
{
  std::vector<std::string> parts;
  std::size_t              begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1)
  {
    end = text.find(',', begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

} // end namespace medialvoxel
