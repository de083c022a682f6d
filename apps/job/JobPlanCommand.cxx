// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ExtractParts.h"
#include "ExtractRun.h"
#include "JobCommands.h"
#include "JobFolder.h"
#include "JobParts.h"
#include "Report.h"
#include "SharedJob.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

namespace medialvoxel
{
namespace
{

/** Voxels read and written for a cluster, in bytes, that take some ten seconds: little to lose when a process is
 * stopped, and much in comparison with the start of a process and with the neighborhood that it reads as well. */
constexpr std::uint64_t BytesPerCluster = std::uint64_t{ 1 } << 29;

/** Fewer would leave processors without work towards the end. */
constexpr std::uint64_t FewestClusters = 16;

void
RefuseUnsupported(const ExtractOptions & options)
{
  const auto refuse = [](const char * what, const char * remedy) {
    Fail(ExitStatus::Refused, what, " cannot be made by a job that can be continued; ", remedy);
  };
  if (!options.meshFile.empty())
  {
    refuse("a mesh, which joins what lies in all clusters,", "run medialvoxel mesh for it");
  }
  if (options.sparse)
  {
    refuse("sparse outputs, whose space is not reserved and may be missing when most is done,",
           "leave out --sparse, or run medialvoxel extract without --resume");
  }
  const auto volumes = { options.output, options.vectorFile, options.distanceFile, options.thicknessFile };
  if (std::any_of(volumes.begin(), volumes.end(), [](const std::string & name) {
        return !name.empty() && GetVolumeFormat(name) == VolumeFormat::Zarr;
      }))
  {
    refuse("a Zarr folder", "write .mha or .nrrd, or run medialvoxel extract without --resume");
  }
  if (!options.returnParameterFile.empty())
  {
    refuse("return parameters", "use the report");
  }
}

void
RefusePacked(const VolumeHeader & header)
{
  if (!header.CanStream())
  {
    Fail(ExitStatus::Refused,
         header.fileName.string(),
         ": every process would have to read the file as a whole (",
         header.DescribeReading(),
         "); store the volume unpacked, or run medialvoxel extract without --resume");
  }
}

/** As many slices as BytesPerCluster, in whole slabs, which are the pieces that cost the least. */
std::uint64_t
ChooseNumberOfClusters(const ExtractOptions & options, const JobResult & job)
{
  if (options.divisions)
  {
    return std::min(*options.divisions, job.plan.numberOfSlices);
  }
  const std::uint64_t bytes = (job.input.GetVoxelBytes() + job.plan.diskBytes) / job.plan.numberOfSlices;
  const std::uint64_t most =
    std::min(BytesPerCluster / std::max<std::uint64_t>(bytes, 1), job.plan.numberOfSlices / FewestClusters);
  const std::uint64_t slab = job.plan.slabSlices;
  const std::uint64_t slices = std::max(slab, most / slab * slab);
  return (job.plan.numberOfSlices - 1) / slices + 1;
}

std::string
MakeJobId()
{
  std::random_device  source;
  std::array<char, 9> digits{};
  std::string         id;
  for (int half = 0; half < 2; ++half)
  {
    std::snprintf(digits.data(), digits.size(), "%08x", source() & 0xffffffffu);
    id += digits.data();
  }
  return id;
}

Manifest
MakeManifest(const PlanOptions & options, const JobResult & job)
{
  Manifest manifest;
  manifest.version = GetVersion();
  manifest.jobId = MakeJobId();
  manifest.folder = std::filesystem::current_path();
  manifest.options = options;
  for (const std::filesystem::path & fileName : ListInputFiles(job.input))
  {
    manifest.input.push_back(IdentifyFile(fileName));
    manifest.input.back().sha256 = options.hashesInput ? HashFile(fileName) : "";
  }
  manifest.numberOfSlices = job.plan.numberOfSlices;
  manifest.numberOfClusters = job.plan.divisions;
  manifest.bytesPerSlice = job.plan.diskBytes / job.plan.numberOfSlices;
  return manifest;
}

void
RemoveVolumes(const Manifest & manifest)
{
  for (const std::string & name : ListVolumeNames(WithAbsoluteNames(manifest.options, manifest.folder)))
  {
    OutputVolume(name, false, false).RemoveShared(manifest.GetSuffix());
  }
}

/** Takes away what a plan left that ended early. */
void
RemoveUnfinished(const JobFolder & folder)
{
  const std::optional<Manifest> manifest = folder.ReadUnfinishedPlan();
  if (manifest)
  {
    RemoveVolumes(*manifest);
  }
  folder.Clear();
}

void
CreateVolumes(const Manifest & manifest, const std::vector<VolumeRequest> & volumes)
{
  for (const VolumeRequest & volume : volumes)
  {
    OutputVolume(volume.fileName, false, false).CreateShared(volume.geometry, volume.layout, manifest.GetSuffix());
  }
}

} // namespace

PlanResult
RunPlan(const PlanOptions & options)
{
  RefuseUnsupported(options);
  PlanResult job{ PrepareExtract(options), std::nullopt };
  RefusePacked(job.input);
  const JobFolder folder(options.jobFolder);
  folder.CheckFree();
  job.plan.divisions = ChooseNumberOfClusters(options, job);
  if (options.slurm)
  {
    job.slurm = PlanSlurmArray(*options.slurm, options, job, folder.GetPath());
  }
  if (options.dryRun)
  {
    return job;
  }
  WithPipelineErrors([&] {
    const auto     volumes = ListVolumes(options, job.input, FindLabelGeometry(options, job.input));
    const Manifest manifest = MakeManifest(options, job);
    folder.Create();
    JobLocks   locks(folder.GetLocksName());
    const auto lock = locks.TryLock(JobLocks::Planning);
    if (!lock || folder.IsPlanned())
    {
      Fail(ExitStatus::Refused, folder.GetPath().string(), ": another process has just planned a job in this folder");
    }
    try
    {
      RemoveUnfinished(folder);
      folder.WriteUnfinishedPlan(manifest);
      const auto script = job.slurm ? WriteSlurmScript(*job.slurm, options.overwrite) : nullptr;
      CreateVolumes(manifest, volumes);
      folder.FinishPlan(manifest);
      if (script)
      {
        script->Publish();
      }
    }
    catch (...)
    {
      RemoveVolumes(manifest);
      folder.Remove();
      throw;
    }
  });
  return job;
}

} // end namespace medialvoxel
