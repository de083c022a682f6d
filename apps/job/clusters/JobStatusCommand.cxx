// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobCommands.h"
#include "SealedJson.h"
#include "SharedJob.h"
#include "Text.h"

namespace medialvoxel
{

JobStatus
GetJobStatus(const std::string & jobFolder)
{
  const JobFolder  folder(jobFolder);
  const SharedJob  job{ folder, folder.ReadManifest() };
  const Manifest & manifest = job.manifest;
  JobStatus        status;
  status.numberOfClusters = manifest.numberOfClusters;
  status.isFinished = folder.IsFinished(manifest);
  for (std::uint64_t cluster = 0; cluster < manifest.numberOfClusters; ++cluster)
  {
    const SliceRange    range = manifest.GetCluster(cluster);
    const std::uint64_t bytes = (range.end - range.begin) * manifest.perSlice;
    status.bytes += bytes;
    if (folder.ReadMarker(manifest, cluster))
    {
      status.done.push_back(cluster);
      status.bytesDone += bytes;
    }
    else
    {
      (IsLocked(folder.GetLocksName(), cluster) ? status.running : status.missing).push_back(cluster);
    }
  }
  if (!status.missing.empty())
  {
    status.nextCommand = MakeWorkCommand(folder, status.missing, manifest.numberOfClusters);
  }
  else if (status.running.empty() && !status.isFinished)
  {
    status.nextCommand = "medialvoxel finalize " + Quote(folder.GetPath().string());
  }
  return status;
}

TextTable
DescribeStatus(const JobStatus & status)
{
  const auto describe = [](const std::vector<std::uint64_t> & clusters) {
    return std::to_string(clusters.size()) + (clusters.empty() ? "" : ": " + FormatClusters(clusters));
  };
  TextTable table{ { "clusters", std::to_string(status.numberOfClusters) },
                   { "done", describe(status.done) },
                   { "running", describe(status.running) },
                   { "missing", describe(status.missing) },
                   { "written", FormatBytes(status.bytesDone) + " of " + FormatBytes(status.bytes) },
                   { "finished", status.isFinished ? "yes" : "no" } };
  if (!status.nextCommand.empty())
  {
    table.emplace_back("next", status.nextCommand);
  }
  return table;
}

std::string
MakeStatusJson(const JobStatus & status)
{
  const auto describe = [](const std::vector<std::uint64_t> & clusters) {
    return Json{ { "number", clusters.size() }, { "clusters", FormatClusters(clusters) } };
  };
  const Json json{ { "clusters", status.numberOfClusters },
                   { "done", describe(status.done) },
                   { "running", describe(status.running) },
                   { "missing", describe(status.missing) },
                   { "bytes", status.bytes },
                   { "bytes_done", status.bytesDone },
                   { "finished", status.isFinished },
                   { "next_command", status.nextCommand } };
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

TextTable
DescribeNextSteps(const std::string & jobFolder, std::uint64_t numberOfClusters)
{
  const JobFolder   folder(jobFolder);
  const std::string name = Quote(folder.GetPath().string());
  return { { "clusters", std::to_string(numberOfClusters) + ", 0 to " + std::to_string(numberOfClusters - 1) },
           { "to do them", "medialvoxel work " + name },
           { "at the end", "medialvoxel finalize " + name } };
}

} // end namespace medialvoxel
