// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FileNames.h"
#include "Job.h"
#include "JobCommands.h"
#include "JobFolder.h"
#include "Outputs.h"
#include "OutputChecks.h"
#include "PipelineErrors.h"
#include "SharedJob.h"
#include "SharedVolume.h"
#include "Version.h"
#include "VolumeFormats.h"
#include "Warnings.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** Voxels read and written for a cluster, in bytes, that take some ten seconds: little to lose when a process is
 * stopped, and much in comparison with the start of a process and with the neighborhood that it reads as well. */
constexpr std::uint64_t WorkPerCluster = std::uint64_t{ 1 } << 29;

/** Fewer would leave processors without work towards the end, and more to lose when a process is stopped. */
constexpr std::uint64_t FewestClusters = 16;

/** Slices of a cluster: with automatic thickness 32 slices take 13 % more time than whole slabs, 16 take 25 to 30 %. */
constexpr std::uint64_t FewestSlices = 16;

void
RefuseUnsupported(const ExtractOptions & options)
{
  const auto refuse = [](const char * what, const char * remedy) {
    Fail(ExitStatus::Refused, what, " cannot be made by a job that can be continued; ", remedy);
  };
  for (const auto & kind : ListOutputKinds(options))
  {
    if (kind.refusal && !(options.*kind.option).empty())
    {
      refuse(kind.refusal->what, kind.refusal->remedy);
    }
  }
  if (options.labels)
  {
    refuse("labels of several objects", "run medialvoxel extract without --resume, or a job for each --label");
  }
  if (options.sparse)
  {
    refuse("sparse outputs, whose space is not reserved and may be missing when most is done,",
           "leave out --sparse, or run medialvoxel extract without --resume");
  }
  const std::vector<std::string> volumes = ListVolumeNames(options);
  if (std::any_of(volumes.begin(), volumes.end(), [&options](const std::string & name) {
        return IsPackedVolume(name, options.compression);
      }))
  {
    refuse("a packed volume, which is one stream,",
           "name it .nii in place of .nii.gz, or leave out --compress; .zarr is packed and can be made by a job");
  }
}

/** Slices of about WorkPerCluster in whole slabs, which are the pieces that cost the least, or fewer, so that there
 * are FewestClusters. */
std::uint64_t
ChooseSlicesOfCluster(const JobResult & job)
{
  const JobPlan &     plan = job.plan;
  const std::uint64_t bytes = (job.input.GetStored().GetDataSize() + plan.disk) / plan.numberOfSlices;
  const std::uint64_t most = plan.numberOfSlices / FewestClusters;
  if (most < plan.slabSlices)
  {
    return std::max(FewestSlices, most);
  }
  const std::uint64_t slabs = std::min(WorkPerCluster / std::max<std::uint64_t>(bytes, 1), most) / plan.slabSlices;
  return std::max<std::uint64_t>(slabs, 1) * plan.slabSlices;
}

/** Whole layers of chunks, which no two processes share. */
void
DivideIntoClusters(const ExtractOptions & options, std::uint64_t slicesOfLayer, JobResult & job)
{
  JobPlan & plan = job.plan;
  plan.sliceUnit = slicesOfLayer;
  const std::uint64_t units = plan.GetNumberOfUnits();
  if (options.divisions)
  {
    plan.divisions = std::min(*options.divisions, units);
    return;
  }
  const std::uint64_t clusterUnits = std::max<std::uint64_t>(ChooseSlicesOfCluster(job) / plan.sliceUnit, 1);
  plan.divisions = (units - 1) / clusterUnits + 1;
}

/** Volumes that clusters are written to. */
std::vector<VolumeRequest>
ListSharedVolumes(const ProductList & products)
{
  std::vector<VolumeRequest> volumes;
  for (const auto & product : products)
  {
    if (const VolumeRequest * const volume = product->GetLinks().request)
    {
      volumes.push_back(*volume);
    }
  }
  return volumes;
}

Manifest
MakeManifest(const ExtractOptions & options,
             const JobResult &      job,
             const JobFolder &      folder,
             const ProductList &    products)
{
  Manifest manifest;
  manifest.version = GetVersion();
  manifest.jobId = MakeUniqueDigits();
  manifest.folder = std::filesystem::current_path();
  std::error_code error;
  manifest.fromJob = manifest.folder.lexically_relative(std::filesystem::weakly_canonical(folder.GetPath(), error));
  manifest.options = options;
  if (!options.scratchFolder.empty())
  {
    manifest.options.scratchFolder = std::filesystem::absolute(options.scratchFolder).string();
  }
  for (const std::filesystem::path & fileName : ListInputFiles(job.input))
  {
    manifest.input.push_back(IdentifyFile(fileName));
  }
  manifest.numberOfSlices = job.plan.numberOfSlices;
  manifest.numberOfClusters = job.plan.divisions;
  manifest.sliceUnit = job.plan.sliceUnit;
  std::uint64_t bytes = 0;
  for (const VolumeRequest & volume : ListSharedVolumes(products))
  {
    bytes += GetOutputSize(volume.fileName, volume.geometry, volume.layout);
  }
  manifest.perSlice = bytes / job.plan.numberOfSlices;
  return manifest;
}

/** Decisions that all processes of the job share: the threshold, smoothing, and the measure of walls. */
ExtractOptions
MeasureVolume(const ExtractOptions & options, Job & job, ProgressSink & sink)
{
  job.Open(sink);
  job.CheckValues(sink);
  job.Prepare(sink);
  job.Measure([&sink](double) { ThrowIfStopRequested(sink); });
  ExtractOptions measured = options;
  measured.lowerThreshold = job.options.lowerThreshold;
  measured.neededMaximum = job.options.neededMaximum;
  measured.roughness = job.result.roughness;
  measured.smoothingLevel = job.result.smoothingLevel;
  measured.measure = job.result.wallMeasure;
  return measured;
}

void
RemoveVolumes(const Manifest & manifest)
{
  for (const std::string & name : ListVolumeNames(WithAbsoluteNames(manifest.options, manifest.folder)))
  {
    MakeSharedVolume(name, manifest.options)->RemoveShared(manifest.GetSuffix());
  }
  RemoveSharedCells(manifest);
}

/** Removes the files of a plan that ended early. */
void
RemoveUnfinished(const JobFolder & folder)
{
  try
  {
    const std::optional<Manifest> manifest = folder.ReadUnfinishedPlan();
    if (manifest)
    {
      RemoveVolumes(*manifest);
    }
  }
  catch (const JobError & error)
  {
    Fail(ExitStatus::Refused,
         error.what(),
         "; a plan that ended early left it: remove the folder, and what ends with .partial beside the outputs");
  }
  folder.Clear();
}

void
CreateVolumes(const Manifest & manifest, const ProductList & products, const ProgressSink & sink)
{
  for (const VolumeRequest & volume : ListSharedVolumes(products))
  {
    ThrowIfStopRequested(sink);
    MakeSharedVolume(volume.fileName, manifest.options)
      ->CreateShared(volume.geometry, volume.layout, manifest.GetSuffix());
  }
}

} // namespace

PlanResult
RunPlan(const PlanOptions & options, ProgressSink & sink)
{
  RefuseUnsupported(options);
  ExtractOptions ofProcess = options;
  ofProcess.divisions.reset(); // here divisions are clusters; each process divides a cluster for its memory
  Job planned(ofProcess);
  planned.Plan(true);
  PlanResult job{ planned.result, std::nullopt };
  job.plan.growingScratch.folder = FolderOf(options.output); // where all processes find it
  TellWarnings(sink, job.warnings);
  const JobFolder folder(options.jobFolder);
  folder.CheckFree();
  CheckJobFolder(folder.GetPath(), job.outputs);
  DivideIntoClusters(options, planned.GetFootprint().slicesOfLayer, job);
  if (options.slurm)
  {
    job.slurm = PlanSlurmArray(*options.slurm, options, job, folder.GetPath());
  }
  if (options.dryRun)
  {
    return job;
  }
  WithPipelineErrors([&] {
    const Manifest manifest = MakeManifest(MeasureVolume(options, planned, sink), job, folder, planned.products);
    folder.Create();
    JobLocks   locks(folder.GetLocksName());
    const auto lock = locks.TryLock(JobLocks::Planning);
    if (!lock || folder.IsPlanned())
    {
      Fail(ExitStatus::Refused, folder.GetPath().string(), ": another process has just planned a job in this folder");
    }
    RemoveUnfinished(folder);
    try
    {
      folder.WriteUnfinishedPlan(manifest);
      const auto script = job.slurm ? WriteSlurmScript(*job.slurm, options.overwrite) : nullptr;
      CreateVolumes(manifest, planned.products, sink);
      folder.FinishPlan(manifest);
      sink.Record({ LogLevel::Info,
                    "planned",
                    { { "job", manifest.jobId },
                      { "folder", folder.GetPath().string() },
                      { "clusters", std::to_string(manifest.numberOfClusters) },
                      { "slices_of_cluster", std::to_string(job.plan.GetMaximumSlices()) },
                      { "planned_memory_bytes", std::to_string(job.plan.memory.planned) } } });
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
