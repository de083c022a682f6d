// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JsonFile.h"

#include "Errors.h"
#include "JsonLimits.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace medialvoxel
{
namespace
{

/** The message of the parser without its quotation of the file, which may be the whole file. */
std::string
WithoutQuotation(const std::string & message)
{
  constexpr std::size_t longest = 200;
  return message.substr(0, std::min(message.find("; last read"), longest));
}

} // namespace

std::string
ReadTextFile(const std::filesystem::path & fileName, std::uint64_t maximumSize)
{
  std::error_code error;
  if (const auto status = std::filesystem::status(fileName, error);
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    // A pipe would be waited for.
    Fail(ExitStatus::Failure, "cannot read ", fileName.string(), ": it is not a regular file");
  }
  std::ifstream file(fileName, std::ios::binary);
  if (!file.is_open())
  {
    Fail(ExitStatus::Failure, "cannot read ", fileName.string(), ": ", std::strerror(errno));
  }
  std::string       text;
  std::vector<char> buffer(std::size_t{ 1 } << 16);
  while (text.size() <= maximumSize && file)
  {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    text.append(buffer.data(), static_cast<size_t>(file.gcount()));
  }
  if (text.size() > maximumSize)
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), " has more than the ", maximumSize, " bytes allowed for it");
  }
  return text;
}

nlohmann::json
ReadJsonFile(const std::filesystem::path & fileName, std::uint64_t maximumSize)
{
  const std::string text = ReadTextFile(fileName, maximumSize);
  try
  {
    constexpr std::uint64_t mostValues = 100000;
    return ParseJson<nlohmann::json>(text, mostValues);
  }
  catch (const nlohmann::json::exception & parseError)
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), " is not JSON: ", WithoutQuotation(parseError.what()));
  }
  catch (const std::length_error & limit)
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), " has ", limit.what(), ", which no metadata have");
  }
}

} // end namespace medialvoxel
