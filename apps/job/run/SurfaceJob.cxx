// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "ExtractRun.h"
#include "FinishJob.h"
#include "JobClock.h"
#include "ObjectRule.h"
#include "OutputSet.h"
#include "OptionChecks.h"
#include "Outputs.h"
#include "PartSurface.h"
#include "PieceLoop.h"
#include "PipelineErrors.h"
#include "PrepareJob.h"
#include "ReadVolumeHeader.h"
#include "ReportSummary.h"
#include "ScanMeasure.h"
#include "StopListener.h"
#include "SurfacePlacement.h"
#include "VolumeJob.h"
#include "VolumeStatistics.h"
#include "Warnings.h"

#include <memory>
#include <utility>

namespace medialvoxel
{
namespace
{

/** The task that maps the thickness, whatever its definition. */
FurtherTask
GetMapTask(const SurfaceOptions & options, const VolumeHeader & header)
{
  return ListFurtherTasks(GetThicknessOptions(options), header).front();
}

/** The volume that the task fills. */
VolumeRequest
GetMapRequest(const SurfaceOptions & options, const VolumeHeader & header)
{
  return ListVolumes(GetThicknessOptions(options), header).front();
}

/** \throw JobError Usage when the values do not place a surface that is to be placed by them */
void
CheckGrayValues(const SurfaceOptions & options, const VolumeHeader & header)
{
  if (!options.subVoxel.value_or(false))
  {
    return;
  }
  if (!HasOneThreshold(options, header))
  {
    Fail(ExitStatus::Usage,
         "a surface between voxels needs one threshold, --lower or --upper, that values of the type ",
         std::string(GetTraits(header.GetValueType()).name),
         " reach");
  }
}

PieceFootprint
GetFootprint(const SurfaceOptions & options, const VolumeHeader & header)
{
  PieceFootprint footprint;
  footprint.bytesPerVoxel = GetMapRequest(options, header).layout.GetBytes();
  footprint.grid = GetGrid(options, header);
  footprint.bytesBeside = PartSurface::GetBytes(options, header);
  footprint.scratch = PartSurface::GetScratchSpace(options, header);
  AddEngine(footprint, header, GetMapTask(options, header).task);
  AddOutputs(footprint, options, header, ListOutputs(options, header));
  return footprint;
}

void
Build(const SurfaceOptions & options, JobResult & result, ProgressSink & sink, JobClock::time_point start)
{
  InputVolume                   input(result.input, options, result.plan.bytesToKeep, Smoothing::Off);
  OutputSet                     outputs(options, false);
  OutputFile &                  file = *outputs.AddFile(options.output);
  ReportSummary<SurfaceOptions> summary(options, outputs);
  PartSurface                   surface(options, result.input, input.GetInput());
  PieceLoop                     loop(result.plan, result.input, 1, sink);
  auto                          engine = std::make_unique<PieceEngine>(
    input.GetInput(), result.input, options, result.plan, GetMapTask(options, result.input).task, loop.GetObserver());
  engine->AddVolume(GetMapRequest(options, result.input), surface.GetMap());
  WriteBehind writer(false); // the surface reads the input, as the engine does
  loop.Prepare(input);
  result.wallMeasure = FindWallMeasure(
    input, result.input, GetThicknessOptions(options), [&loop](double) { loop.ThrowIfStopRequested(); });
  engine->SetGrayRange(GetGrayRange(*result.wallMeasure, options, result.input));
  if (result.wallMeasure->usesGrayValues)
  {
    surface.UseGrayValues();
  }
  if (options.localThicknessMethod == LocalThicknessMethod::Sphere)
  {
    result.wallMeasure = WallMeasure{ false, std::nullopt, "largest balls are those of its voxels" };
  }
  for (std::uint64_t piece = 0; piece < result.plan.divisions; ++piece)
  {
    result.sums += loop.Run(*engine, result.plan.GetPiece(piece), result.plan.GetNextPiece(piece), writer);
  }
  engine.reset(); // what follows takes its memory
  const auto finishStart = JobClock::now();
  JobEnd     end;
  end.complete = [&] { result.part = surface.Write(file, [&loop](double) { loop.ThrowIfStopRequested(); }); };
  end.recordCosts = [&] { AddMeasurements(result, input, writer.GetSeconds() + SecondsSince(finishStart), start); };
  FinishJob(outputs, summary, result, sink, end);
}

} // namespace

JobResult
RunSurface(const SurfaceOptions & options, ProgressSink & sink)
{
  const auto start = JobClock::now();
  CheckOptions(options);
  GetPartFormat(options.output);
  VolumeHeader header = ReadSheetInputHeader(options);
  CheckSurfaceInput(header, options.output, "surface");
  CheckGrayValues(options, header);
  CheckLabel(options, header);
  auto       outputs = ListOutputs(options, header);
  const auto footprint = GetFootprint(options, header);
  JobResult  result = PrepareJob(options, std::move(header), std::move(outputs), footprint);
  result.plan.writesBehind = false;
  result.warnings = FindWarningsOfRequest(options, result.input);
  TellWarnings(sink, result.warnings);
  if (options.dryRun)
  {
    return result;
  }
  SurfaceOptions own = options;
  result.input = UnpackInput(result.input, result.plan, sink);
  MeasureThreshold(own, result.input, sink);
  result.otsu = own.lowerIsOtsu ? own.lowerThreshold : std::nullopt;
  WithPipelineErrors([&] {
    sink.Start("medialvoxel", "building the surface of the part");
    const StopListener listener(&sink);
    Build(own, result, sink, start);
  });
  sink.Finish(result.seconds.total);
  return result;
}

} // end namespace medialvoxel
