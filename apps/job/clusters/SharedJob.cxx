// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SharedJob.h"

#include "ClusterRange.h"
#include "Outputs.h"
#include "SharedVolume.h"

namespace medialvoxel
{
namespace
{

bool
HasRelativeNames(const Manifest & manifest)
{
  const ExtractOptions absolute = WithAbsoluteNames(manifest.options, manifest.folder);
  return !FindDifference(absolute, manifest.options).empty();
}

} // namespace

SharedJob
OpenSharedJob(const std::string & jobFolder)
{
  const JobFolder folder(jobFolder);
  SharedJob       job{ folder, folder.ReadManifest() };
  if (HasRelativeNames(job.manifest))
  {
    std::error_code error;
    std::filesystem::current_path(job.manifest.folder, error);
    if (error)
    {
      Fail(ExitStatus::Failure,
           "cannot enter ",
           job.manifest.folder.string(),
           ", to which the names of the job's files are relative: ",
           error.message(),
           "; move the job folder ",
           folder.GetPath().string(),
           " together with the folder of its outputs, whose names end with ",
           job.manifest.GetSuffix(),
           ", or plan the job with absolute names");
    }
  }
  if (!folder.IsFinished(job.manifest))
  {
    CheckUnchanged(job.manifest.input);
  }
  return job;
}

void
RemoveSharedCells(const Manifest & manifest)
{
  const ExtractOptions options = WithAbsoluteNames(manifest.options, manifest.folder);
  MakeSharedVolume(GetCellsFile(options.output), options)->RemoveShared(manifest.GetSuffix());
}

std::vector<std::uint64_t>
ListMissing(const SharedJob & job)
{
  std::vector<std::uint64_t> missing;
  for (std::uint64_t cluster = 0; cluster < job.manifest.numberOfClusters; ++cluster)
  {
    if (!job.folder.ReadMarker(job.manifest, cluster))
    {
      missing.push_back(cluster);
    }
  }
  return missing;
}

std::string
MakeWorkCommand(const JobFolder & folder, const std::vector<std::uint64_t> & clusters, std::uint64_t numberOfClusters)
{
  return "medialvoxel work " + Quote(folder.GetPath().string()) +
         (clusters.size() < numberOfClusters ? " --clusters " + FormatClusters(clusters) : "");
}

std::string
Quote(const std::string & text)
{
  constexpr const char * harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:@%";
  if (!text.empty() && text.find_first_not_of(harmless) == std::string::npos)
  {
    return text;
  }
  std::string quoted = "'";
  for (const char character : text)
  {
    quoted += character == '\'' ? "'\\''" : std::string(1, character);
  }
  return quoted + "'";
}

} // end namespace medialvoxel
