// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TemporaryName.h"

#include <algorithm>
#include <regex>

namespace medialvoxel
{
namespace
{

/** The text cut to a number of bytes, but not within a character of UTF-8. */
std::string
CutText(const std::string & text, std::size_t maximumSize)
{
  std::size_t size = std::min(text.size(), maximumSize);
  while (size > 0 && size < text.size() && (static_cast<unsigned char>(text[size]) & 0xc0u) == 0x80u)
  {
    --size;
  }
  return text.substr(0, size);
}

} // namespace

std::filesystem::path
MakeTemporaryName(const std::filesystem::path & fileName, int attempt)
{
  constexpr std::size_t   longestName = 255;
  const ProcessIdentity & process = GetThisProcess();
  const std::string       host = process.host.empty() ? std::string(12, '0') : process.host;
  const std::string       suffix = "." + host + "-" + std::to_string(process.number) + "-" +
                             std::to_string(process.startTime) + "-" + std::to_string(attempt) + ".partial";
  std::filesystem::path name = fileName;
  return name.replace_filename(CutText(fileName.filename().string(), longestName - suffix.size()) + suffix);
}

std::optional<TemporaryName>
ParseTemporaryName(const std::string & name)
{
  static const std::regex pattern(R"((.+)\.([0-9a-f]{12})-([0-9]{1,9})-([0-9]{1,18})-[0-9]{1,4}\.partial)");
  std::smatch             parts;
  if (!std::regex_match(name, parts, pattern))
  {
    return std::nullopt;
  }
  return TemporaryName{ parts[1], { parts[2], std::stoi(parts[3]), std::stoull(parts[4]) } };
}

} // end namespace medialvoxel
