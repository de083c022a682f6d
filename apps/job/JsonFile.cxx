// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JsonFile.h"

#include "Errors.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace medialvoxel
{

std::string
ReadTextFile(const std::filesystem::path & fileName, std::uint64_t maximumBytes)
{
  std::error_code error;
  std::ifstream   file;
  if (!std::filesystem::is_directory(fileName, error))
  {
    file.open(fileName, std::ios::binary);
  }
  if (!file.is_open())
  {
    Fail(ExitStatus::Failure, "cannot read ", fileName.string(), ": ", std::strerror(errno));
  }
  std::string       text;
  std::vector<char> buffer(std::size_t{ 1 } << 16);
  while (text.size() <= maximumBytes && file)
  {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    text.append(buffer.data(), static_cast<size_t>(file.gcount()));
  }
  if (text.size() > maximumBytes)
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), " has more than the ", maximumBytes, " bytes allowed for it");
  }
  return text;
}

nlohmann::json
ReadJsonFile(const std::filesystem::path & fileName, std::uint64_t maximumBytes)
{
  const std::string text = ReadTextFile(fileName, maximumBytes);
  try
  {
    return nlohmann::json::parse(text);
  }
  catch (const nlohmann::json::parse_error & parseError)
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), " is not JSON: ", parseError.what());
  }
}

} // end namespace medialvoxel
