// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobFolder.h"

#include "Checksum.h"
#include "SealedJson.h"
#include "Text.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>

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

/** Names of files that a job without a manifest may have left, and of temporary files of killed processes. */
bool
IsOurs(const std::string & name)
{
  static const std::regex pattern(R"((planned|publishing|finished)\.json|)"
                                  R"((manifest|planned|publishing|finished)\.json\.[0-9]+-[0-9]+\.partial|)"
                                  R"(slurm\.sh\.[0-9]+-[0-9]+\.partial)");
  return std::regex_match(name, pattern);
}

/** The same in the folder of the clusters. */
bool
IsOfCluster(const std::string & name)
{
  static const std::regex pattern(R"([0-9]{6,}\.(json|survey)(\.[0-9]+-[0-9]+\.partial)?)");
  return std::regex_match(name, pattern);
}

template <typename TCondition>
void
RemoveFiles(const std::filesystem::path & folder, TCondition condition)
{
  std::error_code error;
  for (const auto & entry : std::filesystem::directory_iterator(folder, error))
  {
    if (condition(entry.path().filename().string()))
    {
      std::filesystem::remove(entry.path(), error);
    }
  }
}

/** True for a folder that cannot be read: nothing in it is to be touched. */
template <typename TCondition>
bool
HasOthers(const std::filesystem::path & folder, TCondition condition)
{
  std::error_code                           error;
  const std::filesystem::directory_iterator entries(folder, error);
  return error || std::any_of(begin(entries), end(entries), [&](const auto & entry) {
           return !condition(entry.path().filename().string());
         });
}

bool
HasOnlyLeftovers(const std::filesystem::path & folder)
{
  const auto isLeftover = [](const std::string & name) {
    return name == LocksName || name == ClustersName || IsOurs(name);
  };
  std::error_code error;
  const bool      hasClusters = std::filesystem::exists(folder / ClustersName, error);
  return !HasOthers(folder, isLeftover) && !(hasClusters && HasOthers(folder / ClustersName, IsOfCluster));
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
  manifest->folder = FindFolder(*manifest, m_Path);
  return *std::move(manifest);
}

void
JobFolder::CheckStillOf(const Manifest & manifest) const
{
  if (!this->IsPlanned() || this->ReadManifest().jobId != manifest.jobId)
  {
    Fail(ExitStatus::Failure,
         m_Path.string(),
         " is no longer the folder of this job, which was finished or given up meanwhile");
  }
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
  if (this->IsPlanned())
  {
    Fail(ExitStatus::Refused,
         m_Path.string(),
         " is not empty, it has a job; medialvoxel status shows its progress; a new job needs a folder of its own");
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
  std::optional<Manifest> manifest = medialvoxel::ReadManifest(m_Path / PlannedName);
  if (manifest)
  {
    manifest->folder = FindFolder(*manifest, m_Path);
  }
  return manifest;
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
  const std::filesystem::path name = this->GetClusterName(cluster, ".json");
  std::error_code             error;
  std::filesystem::remove(name, error);
  if (error)
  {
    Fail(ExitStatus::Failure, "cannot remove ", name.string(), ", whose cluster is damaged: ", error.message());
  }
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

std::optional<DataNames>
JobFolder::ReadDataNames(const Manifest & manifest) const
{
  const std::optional<Json> record = ReadSealed(m_Path / PublishingName);
  if (!record || record->value("job", "") != manifest.jobId)
  {
    return std::nullopt;
  }
  using Names = std::map<std::string, std::string>;
  return DataNames{ record->at("data_files").get<Names>(), record->at("replaced_files").get<Names>() };
}

void
JobFolder::WriteDataNames(const Manifest & manifest, const DataNames & names) const
{
  WriteSealed(m_Path / PublishingName,
              { { "job", manifest.jobId }, { "data_files", names.chosen }, { "replaced_files", names.replaced } });
}

void
JobFolder::WriteFinished(const Manifest & manifest, WallVerdict verdict) const
{
  WriteSealed(m_Path / FinishedName, { { "job", manifest.jobId }, { "verdict", static_cast<int>(verdict) } });
}

WallVerdict
JobFolder::GetVerdict(const Manifest & manifest) const
{
  const std::optional<Json> record = ReadSealed(m_Path / FinishedName);
  const int  verdict = record && record->value("job", "") == manifest.jobId ? record->value("verdict", -1) : -1;
  const bool isKnown = verdict >= 0 && verdict <= static_cast<int>(WallVerdict::NotMeasured);
  return isKnown ? static_cast<WallVerdict>(verdict) : WallVerdict::NotMeasured;
}

void
JobFolder::Clear() const
{
  // The manifest first: without it the other files belong to no job.
  std::error_code error;
  std::filesystem::remove(m_Path / ManifestName, error);
  RemoveFiles(m_Path / ClustersName, IsOfCluster);
  RemoveFiles(m_Path, IsOurs);
}

void
JobFolder::RemoveFinished() const
{
  // While the manifest and the record are there, the job counts as finished.
  std::error_code error;
  RemoveFiles(m_Path / ClustersName, IsOfCluster);
  std::filesystem::remove(m_Path / ClustersName, error);
  std::filesystem::remove(m_Path / LocksName, error);
  RemoveFiles(m_Path, [](const std::string & name) { return name != FinishedName && IsOurs(name); });
  this->Remove();
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
