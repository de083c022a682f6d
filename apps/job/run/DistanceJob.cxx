// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobParts.h"
#include "OutputSet.h"
#include "Report.h"
#include "ValueStatistics.h"

#include <optional>

namespace medialvoxel
{
namespace
{

std::vector<OutputRequest>
ListCandidates(const DistanceOptions & options, const VolumeHeader & header)
{
  return { { "vectors", options.output, GetVectorLayout(header) },
           { "distance", options.distanceFile, DistanceLayout },
           { "report", GetReportFile(options), std::nullopt } };
}

PieceFootprint
GetFootprint(const DistanceOptions & options, const VolumeHeader & header)
{
  PieceFootprint footprint;
  footprint.bytesPerVoxel =
    GetVectorLayout(header).GetBytes() + (options.distanceFile.empty() ? 0 : DistanceLayout.GetBytes());
  footprint.grid = GetGrid(options, header);
  AddEngine(footprint, header, itk::MedialVoxelDistanceMap{ options.boundary });
  AddOutputs(footprint, options, header, ListCandidates(options, header));
  return footprint;
}

DistanceSettings
GetSettings(const DistanceOptions & options, const JobPlan & plan)
{
  DistanceSettings settings;
  settings.cut = GetCutSettings(plan);
  settings.boundary = options.boundary;
  settings.region = options.region;
  settings.generateDistance = !options.distanceFile.empty();
  settings.squaredDistance = options.squaredDistance;
  settings.insideIsPositive = options.insideIsPositive;
  settings.maximumDistance = options.maximumDistance;
  return settings;
}

void
Compute(const DistanceOptions & options, JobResult & result, ProgressSink & sink, JobClock::time_point start)
{
  const auto input = OpenInputVolume(result.input, options, result.plan.scratchFolder);
  PieceLoop  loop(result.plan, result.input, 1, sink);
  const auto runner =
    MakeDistanceRunner(*input, result.input, options, GetSettings(options, result.plan), loop.GetObserver());
  OutputSet           outputs(options, result.plan.writesBehind);
  VoxelOutput * const vectors = outputs.AddVolume(options.output, result.input.geometry, GetVectorLayout(result.input));
  VoxelOutput * const distances = outputs.AddVolume(options.distanceFile, result.input.geometry, DistanceLayout);
  OutputFile * const  report = outputs.AddFile(GetReportFile(options));

  WriteBehind writer(result.plan.writesBehind);
  if (result.plan.writesBehind)
  {
    runner->KeepPreviousResults();
  }

  loop.Prepare(*input);
  const auto write = [=](const PieceLoop::Range & range, const PieceResults & results) {
    vectors->Write(range.firstVoxel, range.numberOfVoxels, results.vectors);
    if (distances)
    {
      distances->Write(range.firstVoxel, range.numberOfVoxels, results.distances);
    }
  };
  for (std::uint64_t piece = 0; piece < result.plan.divisions; ++piece)
  {
    loop.Run(*runner, result.plan.GetPiece(piece), writer, write);
  }
  writer.Wait();
  result.sums = runner->GetSums();

  const auto finishStart = JobClock::now();
  outputs.FinishVolumes();
  loop.ThrowIfStopRequested();
  AddMeasurements(result, *input, writer.GetSeconds() + SecondsSince(finishStart), start);
  const std::vector<Warning> found = FindWarningsOfResult(options, result);
  result.warnings.insert(result.warnings.end(), found.begin(), found.end());
  if (report)
  {
    WriteText(*report, MakeReport(options, result));
  }
  outputs.Publish();
}

} // namespace

JobResult
RunDistance(const DistanceOptions & options, ProgressSink & sink)
{
  const auto start = JobClock::now();
  CheckOptions(options);
  GetVolumeFormat(options.output);
  VolumeHeader header = ReadInputHeader(options);
  CheckLabel(options, header);
  const auto candidates = ListCandidates(options, header);
  const auto footprint = GetFootprint(options, header);
  JobResult  result = PrepareJob(options, std::move(header), candidates, footprint);
  result.warnings = FindWarningsOfRequest(options, result.input);
  TellWarnings(sink, result.warnings);
  const std::size_t told = result.warnings.size();
  if (options.dryRun)
  {
    return result;
  }
  DistanceOptions own = options;
  MeasureThreshold(own, result.input, sink);
  result.otsu = own.lowerIsOtsu ? own.lowerThreshold : std::nullopt;
  WithPipelineErrors([&] {
    sink.Start("medialvoxel", "computing vector distances");
    const StopListener listener(&sink);
    Compute(own, result, sink, start);
  });
  TellWarnings(sink, result.warnings, told);
  sink.Finish(result.seconds.total);
  return result;
}

} // end namespace medialvoxel
