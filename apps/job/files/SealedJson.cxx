// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SealedJson.h"

#include "Checksum.h"
#include "Errors.h"
#include "JsonFile.h"
#include "JsonLimits.h"
#include "OutputFile.h"

#include <utility>

namespace medialvoxel
{
namespace
{

constexpr const char * SealName = "checksum";

/** Far above any file of a job, so that no other file fills the memory. */
constexpr std::uint64_t MaximumSize = std::uint64_t{ 1 } << 26;

std::uint32_t
GetSeal(const Json & object)
{
  return GetChecksum(object.dump());
}

/** The object without its seal; nothing when there is none that fits. */
std::optional<Json>
Unseal(const std::string & text)
try
{
  Json object = ParseJson<Json>(text, text.size());
  if (!object.is_object() || !object.contains(SealName) || !object[SealName].is_number_unsigned())
  {
    return std::nullopt;
  }
  const auto seal = object[SealName].get<std::uint64_t>();
  object.erase(SealName);
  return seal == GetSeal(object) ? std::optional<Json>(std::move(object)) : std::nullopt;
}
catch (const Json::exception &)
{
  return std::nullopt;
}
catch (const std::length_error &)
{
  return std::nullopt;
}

} // namespace

void
WriteDurably(const std::filesystem::path & fileName, const std::string & text)
{
  try
  {
    WriteTextFile(fileName, text, true);
  }
  catch (const JobError & error)
  {
    throw JobError(ExitStatus::Failure, error.what());
  }
}

void
WriteSealed(const std::filesystem::path & fileName, Json object)
{
  try
  {
    object[SealName] = GetSeal(object);
    WriteDurably(fileName, object.dump(2) + "\n");
  }
  catch (const Json::type_error &)
  {
    Fail(ExitStatus::Usage, fileName.string(), ": the names of the files of a job must be valid UTF-8");
  }
}

std::optional<Json>
ReadSealed(const std::filesystem::path & fileName)
{
  std::error_code error;
  if (!std::filesystem::exists(fileName, error) && (!error || error == std::errc::no_such_file_or_directory))
  {
    return std::nullopt;
  }
  if (std::optional<Json> object = Unseal(ReadTextFile(fileName, MaximumSize)))
  {
    return object;
  }
  Fail(ExitStatus::Failure, fileName.string(), " is damaged or was changed: its checksum does not fit");
}

} // end namespace medialvoxel
