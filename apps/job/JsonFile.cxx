// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JsonFile.h"

#include "Errors.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

namespace medialvoxel
{

nlohmann::json
ReadJsonFile(const std::filesystem::path & fileName, std::uint64_t maximumBytes)
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
  std::string text(maximumBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(file.gcount()));
  if (text.size() > maximumBytes)
  {
    Fail(ExitStatus::CorruptInput, fileName.string(), " has more than the ", maximumBytes, " bytes allowed for it");
  }
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
