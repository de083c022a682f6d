// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FinishJob.h"
#include "JobClock.h"
#include "OutputSet.h"
#include "Outputs.h"
#include "PieceLoop.h"
#include "PipelineErrors.h"
#include "PrepareJob.h"
#include "ReadVolumeHeader.h"
#include "Report.h"
#include "StopListener.h"
#include "ValueStatistics.h"
#include "VolumeFormats.h"
#include "VolumeJob.h"
#include "Warnings.h"

#include <optional>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

PieceFootprint
GetFootprint(const DistanceOptions & options, const VolumeHeader & header)
{
  PieceFootprint footprint;
  footprint.bytesPerVoxel =
    GetVectorLayout(header).GetBytes() + (options.distanceFile.empty() ? 0 : DistanceLayout.GetBytes());
  footprint.grid = GetGrid(options, header);
  AddEngine(footprint, header, itk::MedialVoxelDistanceMap{ options.boundary });
  AddOutputs(footprint, options, header, ListOutputs(options, header));
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
  settings.maximumDistance = options.maximumDistance;
  return settings;
}

class DistanceSummary : public JobSummary
{
public:
  DistanceSummary(const DistanceOptions & options, OutputSet & outputs)
    : m_Options(options)
    , m_Report(outputs.AddFile(GetReportFile(options)))
  {}

  void
  Write(JobResult & result) override
  {
    const std::vector<Warning> found = FindWarningsOfResult(m_Options, result);
    result.warnings.insert(result.warnings.end(), found.begin(), found.end());
    if (m_Report)
    {
      WriteText(*m_Report, MakeReport(m_Options, result));
    }
  }

private:
  const DistanceOptions & m_Options;
  OutputFile *            m_Report;
};

void
Compute(const DistanceOptions & options, JobResult & result, ProgressSink & sink, JobClock::time_point start)
{
  const auto input = OpenInputVolume(result.input, options, result.plan.scratchFolder);
  PieceLoop  loop(result.plan, result.input, 1, sink);
  const auto runner =
    MakeDistanceRunner(*input, result.input, options, GetSettings(options, result.plan), loop.GetObserver());
  OutputSet                                            outputs(options, result.plan.writesBehind);
  std::vector<std::pair<VolumeContent, VoxelOutput *>> volumes;
  for (const VolumeRequest & request : ListVolumes(options, result.input, runner->GetGeometry()))
  {
    volumes.emplace_back(request.content, &outputs.AddVolume(request));
  }
  DistanceSummary summary(options, outputs);

  WriteBehind writer(result.plan.writesBehind);
  if (result.plan.writesBehind)
  {
    runner->KeepPreviousResults();
  }

  loop.Prepare(*input);
  const auto write = [&volumes](const PieceLoop::Range & range, const PieceResults & results) {
    for (const auto & [content, volume] : volumes)
    {
      volume->Write(range.firstVoxel, range.numberOfVoxels, results[content]);
    }
  };
  for (std::uint64_t piece = 0; piece < result.plan.divisions; ++piece)
  {
    loop.Run(*runner, result.plan.GetPiece(piece), writer, write);
  }
  writer.Wait();
  result.sums = runner->GetSums();

  const auto finishStart = JobClock::now();
  JobEnd     end;
  end.measure = [&] { AddMeasurements(result, *input, writer.GetSeconds() + SecondsSince(finishStart), start); };
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
