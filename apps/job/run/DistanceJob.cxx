// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FinishJob.h"
#include "JobClock.h"
#include "ObjectRule.h"
#include "OutputSet.h"
#include "OptionChecks.h"
#include "Outputs.h"
#include "PieceLoop.h"
#include "PipelineErrors.h"
#include "PrepareJob.h"
#include "ReadVolumeHeader.h"
#include "ReportSummary.h"
#include "StopListener.h"
#include "VolumeFormats.h"
#include "VolumeJob.h"
#include "VolumeStatistics.h"
#include "Warnings.h"

#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

itk::MedialVoxelDistanceMap
MakeDistanceMap(const DistanceOptions & options)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return { options.boundary, options.region, options.maximumDistance.value_or(infinity) };
}

PieceFootprint
GetFootprint(const DistanceOptions & options, const VolumeHeader & header)
{
  PieceFootprint footprint;
  footprint.bytesPerVoxel = GetBytesPerVoxel(ListVolumes(options, header), VolumeFiller::Distance);
  footprint.grid = GetGrid(options, header);
  AddEngine(footprint, header, MakeDistanceMap(options));
  AddOutputs(footprint, options, header, ListOutputs(options, header));
  return footprint;
}

void
Compute(const DistanceOptions & options, JobResult & result, ProgressSink & sink, JobClock::time_point start)
{
  InputVolume input(result.input, options, result.plan.bytesToKeep, Smoothing::Off);
  PieceLoop   loop(result.plan, result.input, 1, sink);
  PieceEngine engine(
    input.GetInput(), result.input, options, result.plan, MakeDistanceMap(options), loop.GetObserver());
  OutputSet outputs(options, result.plan.writesBehind);
  for (const VolumeRequest & request : ListVolumes(options, result.input))
  {
    engine.AddVolume(request, outputs.AddVolume(request));
  }
  ReportSummary<DistanceOptions> summary(options, outputs);

  WriteBehind writer(result.plan.writesBehind);
  if (result.plan.writesBehind)
  {
    engine.KeepPreviousResults();
  }

  loop.Prepare(input);
  for (std::uint64_t piece = 0; piece < result.plan.divisions; ++piece)
  {
    result.sums += loop.Run(engine, result.plan.GetPiece(piece), result.plan.GetNextPiece(piece), writer);
  }
  writer.Wait();

  const auto finishStart = JobClock::now();
  JobEnd     end;
  end.recordCosts = [&] { AddMeasurements(result, input, writer.GetSeconds() + SecondsSince(finishStart), start); };
  FinishJob(outputs, summary, result, sink, end);
}

} // namespace

JobResult
RunDistance(const DistanceOptions & options, ProgressSink & sink)
{
  const auto start = JobClock::now();
  CheckOptions(options);
  FindOutputFormat(options.output);
  VolumeHeader header = ReadInputHeader(options);
  CheckLabel(options, header);
  auto       outputs = ListOutputs(options, header);
  const auto footprint = GetFootprint(options, header);
  JobResult  result = PrepareJob(options, std::move(header), std::move(outputs), footprint);
  result.warnings = FindWarningsOfRequest(options, result.input);
  TellWarnings(sink, result.warnings);
  if (options.dryRun)
  {
    return result;
  }
  DistanceOptions own = options;
  result.input = UnpackInput(result.input, result.plan, sink);
  MeasureThreshold(own, result.input, sink);
  result.otsu = own.lowerIsOtsu ? own.lowerThreshold : std::nullopt;
  WithPipelineErrors([&] {
    sink.Start("medialvoxel", "computing vector distances");
    const StopListener listener(&sink);
    Compute(own, result, sink, start);
  });
  sink.Finish(result.seconds.total);
  return result;
}

} // end namespace medialvoxel
