// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobFolder.h"

#include "Checksum.h"
#include "SealedJson.h"
#include "Text.h"

#include <fstream>
#include <iterator>

namespace medialvoxel
{
namespace
{

constexpr const char * ManifestName = "manifest.json";
constexpr const char * PlannedName = "planned.json";
constexpr const char * PublishingName = "publishing.json";
constexpr const char * FinishedName = "finished.json";
constexpr const char * ClustersName = "clusters";
constexpr const char * LocksName = "locks";

/** Files of ours, and those that a process which was killed left while it wrote one of ours. */
bool
IsOurs(const std::filesystem::path & fileName)
{
  const std::string name = fileName.filename().string();
  const std::string stem = name.substr(0, name.find('.'));
  for (const char * const ours : { ManifestName, PlannedName, PublishingName, FinishedName })
  {
    if (name.rfind(ours, 0) == 0)
    {
      return true;
    }
  }
  return !stem.empty() && stem.find_first_not_of("0123456789") == std::string::npos;
}

void
RemoveOurs(const std::filesystem::path & folder)
{
  std::error_code error;
  for (const auto & entry : std::filesystem::directory_iterator(folder, error))
  {
    if (IsOurs(entry.path()))
    {
      std::filesystem::remove(entry.path(), error);
    }
  }
}

bool
HasOnlyLeftovers(const std::filesystem::path & folder)
{
  std::error_code error;
  for (const auto & entry : std::filesystem::directory_iterator(folder, error))
  {
    const std::string name = entry.path().filename().string();
    if (name == ManifestName || (name != LocksName && name != ClustersName && !IsOurs(entry.path())))
    {
      return false;
    }
  }
  return !error;
}

} // namespace

JobFolder::JobFolder(const std::filesystem::path & folder)
  : m_Path(std::filesystem::absolute(folder).lexically_normal())
{}

bool
JobFolder::IsPlanned() const
{
  std::error_code error;
  return std::filesystem::exists(m_Path / ManifestName, error);
}

bool
JobFolder::IsFinished(const Manifest & manifest) const
{
  const std::optional<Json> record = ReadSealed(m_Path / FinishedName);
  return record && record->value("job", "") == manifest.jobId;
}

std::filesystem::path
JobFolder::GetLocksName() const
{
  return m_Path / LocksName;
}

Manifest
JobFolder::ReadManifest() const
{
  std::optional<Manifest> manifest = medialvoxel::ReadManifest(m_Path / ManifestName);
  if (!manifest)
  {
    Fail(ExitStatus::Failure,
         m_Path.string(),
         " is not a job folder, it has no ",
         ManifestName,
         "; medialvoxel plan makes one");
  }
  return *std::move(manifest);
}

void
JobFolder::CheckFree() const
{
  std::error_code error;
  if (!std::filesystem::exists(m_Path, error))
  {
    return;
  }
  if (!std::filesystem::is_directory(m_Path, error))
  {
    Fail(ExitStatus::Refused, m_Path.string(), " is not a folder; a job needs one of its own");
  }
  if (!HasOnlyLeftovers(m_Path))
  {
    Fail(ExitStatus::Refused, m_Path.string(), " is not empty; a job needs a folder of its own");
  }
}

void
JobFolder::Create() const
{
  std::error_code error;
  std::filesystem::create_directory(m_Path, error);
  if (error)
  {
    Fail(ExitStatus::Refused, "cannot create the folder ", m_Path.string(), ": ", error.message());
  }
  this->CheckFree();
  std::filesystem::create_directory(m_Path / ClustersName, error);
  if (error)
  {
    Fail(ExitStatus::Refused, "cannot create a folder in ", m_Path.string(), ": ", error.message());
  }
}

std::optional<Manifest>
JobFolder::ReadUnfinishedPlan() const
{
  return medialvoxel::ReadManifest(m_Path / PlannedName);
}

void
JobFolder::WriteUnfinishedPlan(const Manifest & manifest) const
{
  WriteManifest(m_Path / PlannedName, manifest);
}

void
JobFolder::FinishPlan(const Manifest & manifest) const
{
  WriteManifest(m_Path / ManifestName, manifest);
  std::error_code error;
  std::filesystem::remove(m_Path / PlannedName, error);
}

std::filesystem::path
JobFolder::GetClusterName(std::uint64_t cluster, const char * extension) const
{
  constexpr std::size_t digits = 6;
  std::string           number = std::to_string(cluster);
  number.insert(0, digits - std::min(digits, number.size()), '0');
  return m_Path / ClustersName / (number + extension);
}

std::optional<ClusterMarker>
JobFolder::ReadMarker(const Manifest & manifest, std::uint64_t cluster) const
{
  return medialvoxel::ReadMarker(this->GetClusterName(cluster, ".json"), manifest, cluster);
}

void
JobFolder::WriteMarker(const Manifest &    manifest,
                       std::uint64_t       cluster,
                       ClusterMarker       marker,
                       const std::string & survey) const
{
  if (!survey.empty())
  {
    marker.survey = GetChecksum(survey);
    WriteDurably(this->GetClusterName(cluster, ".survey"), survey);
  }
  medialvoxel::WriteMarker(this->GetClusterName(cluster, ".json"), manifest, cluster, marker);
}

void
JobFolder::RemoveMarker(std::uint64_t cluster) const
{
  std::error_code error;
  std::filesystem::remove(this->GetClusterName(cluster, ".json"), error);
}

std::optional<std::string>
JobFolder::ReadSurvey(std::uint64_t cluster, const ClusterMarker & marker) const
{
  std::ifstream     file(this->GetClusterName(cluster, ".survey"), std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  if (!file || marker.survey != GetChecksum(bytes))
  {
    return std::nullopt;
  }
  return bytes;
}

std::optional<std::map<std::string, std::string>>
JobFolder::ReadDataNames(const Manifest & manifest) const
{
  const std::optional<Json> record = ReadSealed(m_Path / PublishingName);
  if (!record || record->value("job", "") != manifest.jobId)
  {
    return std::nullopt;
  }
  return record->at("data_files").get<std::map<std::string, std::string>>();
}

void
JobFolder::WriteDataNames(const Manifest & manifest, const std::map<std::string, std::string> & names) const
{
  WriteSealed(m_Path / PublishingName, { { "job", manifest.jobId }, { "data_files", names } });
}

void
JobFolder::WriteFinished(const Manifest & manifest) const
{
  WriteSealed(m_Path / FinishedName, { { "job", manifest.jobId } });
}

void
JobFolder::Clear() const
{
  // The manifest first: what else is there then belongs to no job.
  std::error_code error;
  std::filesystem::remove(m_Path / ManifestName, error);
  RemoveOurs(m_Path / ClustersName);
  RemoveOurs(m_Path);
}

void
JobFolder::Remove() const
{
  std::error_code error;
  this->Clear();
  std::filesystem::remove(m_Path / ClustersName, error);
  std::filesystem::remove(m_Path / LocksName, error);
  std::filesystem::remove(m_Path, error);
}

} // end namespace medialvoxel
