// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Job.h"

#include "JobRun.h"
#include "LabelMap.h"
#include "Leftovers.h"
#include "ObjectRule.h"
#include "ObjectWarnings.h"
#include "OptionChecks.h"
#include "OutputChecks.h"
#include "Outputs.h"
#include "Plan.h"
#include "ProcessMemory.h"
#include "Products.h"
#include "ReadVolumeHeader.h"
#include "ScanMeasure.h"
#include "SegmentFiles.h"
#include "MeshFormat.h"
#include "MeshPlacement.h"
#include "SheetRemeshing.h"
#include "UnpackedVolume.h"
#include "VolumeFormats.h"
#include "VolumeStatistics.h"
#include "Warnings.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace medialvoxel
{
namespace
{

// Checks of commands before they read anything.

void
CheckFormats(const ExtractOptions & options)
{
  CheckExtensions(options);
  if (!options.meshFile.empty())
  {
    GetMeshFormat(options.meshFile);
  }
  const auto & kinds = ListOutputKinds(options);
  if (!options.failsIfThin &&
      std::all_of(kinds.begin(), kinds.end(), [&](const auto & kind) { return (options.*kind.option).empty(); }))
  {
    Fail(ExitStatus::Usage, "no output is asked for; give OUTPUT, or an option with a file such as --html part.html");
  }
  if (!options.output.empty())
  {
    FindOutputFormat(options.output);
  }
}

void
CheckFormats(const DistanceOptions & options)
{
  FindOutputFormat(options.output);
}

void
CheckFormats(const PartOptions & options)
{
  GetPartFormat(options.output);
}

/** \throw JobError Usage when there is no threshold that something could be measured or placed at. */
void
RefuseLackOfThreshold(const char * what, const VolumeHeader & header)
{
  Fail(ExitStatus::Usage,
       what,
       " one threshold, --lower or --upper, that values of the type ",
       std::string(GetTraits(header.GetValueType()).name),
       " reach");
}

// Checks of the volume.

void
CheckInput(const ExtractOptions & options, const VolumeHeader & header)
{
  if (!options.meshFile.empty())
  {
    CheckMeshInput(header, options.meshFile, "medial surface");
    CheckElementSize(options, header.geometry);
  }
  if (NumbersWalls(options))
  {
    CheckDimension(header, "sheet of walls");
  }
  if ((options.materials || !options.uncertaintyFile.empty()) && !HasOneThreshold(options, header))
  {
    RefuseLackOfThreshold(options.materials ? "levels of gray values need" : "the uncertainty of the thickness need",
                          header);
  }
}

void
CheckInput(const DistanceOptions &, const VolumeHeader &)
{}

void
CheckInput(const PartOptions & options, const VolumeHeader & header)
{
  CheckMeshInput(header, options.output, "surface");
  if (options.subVoxel.value_or(false) && !HasOneThreshold(options, header))
  {
    RefuseLackOfThreshold("a surface between voxels needs", header);
  }
}

template <typename TOptions>
VolumeHeader
ReadCheckedHeader(const TOptions & options)
{
  CheckOptions(options);
  CheckFormats(options);
  constexpr bool hasSheets = !std::is_same_v<TOptions, DistanceOptions>;
  VolumeHeader   header = hasSheets ? ReadSheetInputHeader(options) : ReadInputHeader(options);
  CheckInput(options, header);
  CheckLabel(options, header);
  return header;
}

/** Names and colors of the labels that the options choose, which are numbers then. */
SegmentTable
ChooseSegments(ExtractOptions & options, const JobResult & job)
{
  if (!options.labels)
  {
    if (!options.objectFile.empty())
    {
      Fail(ExitStatus::Usage, options.objectFile, ": objects are those of several labels; none are chosen");
    }
    return {};
  }
  const SegmentTable all =
    options.segmentFile.empty() ? ReadSegmentsOfVolume(job.input) : ReadSegments(options.segmentFile);
  SegmentTable selected = SelectSegments(all, ResolveNames(*options.labels, all));
  CheckSegments(options.objectFile, selected);
  options.labels = ResolveNames(*options.labels, selected);
  return selected;
}

// The tasks of commands.

std::vector<JobTask>
ListTasks(const ExtractOptions & options, const VolumeHeader & header)
{
  const itk::MedialVoxelGrid                                grid = GetGrid(header);
  std::optional<itk::MedialVoxelSheetExtraction::GrayRange> range;
  if (MayMeasureOnGrayValues(options, header))
  {
    range = GetGrayRange(options, header);
  }
  itk::MedialVoxelSheetExtraction extraction;
  extraction.parameters = GetParameters(options, grid);
  extraction.measuresThickness = MeasuresWalls(options);
  extraction.findsLevels = options.sameTopology;
  extraction.findsImportanceThreshold = !options.importanceThresholdFile.empty();
  extraction.findsImportance = FindsImportance(options);
  extraction.grayRange = range;
  if (!options.vectorFile.empty())
  {
    extraction.vectorBoundary = options.vectorBoundary;
  }
  std::vector<JobTask> tasks{ { VolumeFiller::Extraction, extraction, range.has_value() } };
  if (!options.distanceFile.empty())
  {
    itk::MedialVoxelDistanceMap map;
    map.findsDisplacements = false;
    tasks.push_back({ VolumeFiller::Distance, map });
  }
  if (!options.localThicknessFile.empty())
  {
    auto thickness = GetLocalThickness(options, grid);
    if (thickness.walls)
    {
      thickness.walls->grayRange = range;
    }
    tasks.push_back({ VolumeFiller::LocalThickness, thickness, thickness.walls && range });
  }
  return tasks;
}

std::vector<JobTask>
ListTasks(const DistanceOptions & options, const VolumeHeader &)
{
  const double maximum = options.maximumDistance.value_or(std::numeric_limits<double>::infinity());
  return { { VolumeFiller::Distance, itk::MedialVoxelDistanceMap{ options.boundary, options.region, maximum } } };
}

std::vector<JobTask>
ListTasks(const PartOptions & options, const VolumeHeader & header)
{
  return { ListTasks(GetThicknessOptions(options), header).back() };
}

/** Lets the process keep to the plan: its threads, and memory that is given back. */
void
PrepareProcess(const JobPlan & plan)
{
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(plan.threads);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(plan.threads);
  GiveLargeBlocksBack();
}

} // namespace

template <typename TOptions>
Job::Job(const TOptions & wanted, VolumeHeader header)
  : command(wanted)
  , options(std::get<TOptions>(command))
{
  const auto & own = std::get<TOptions>(command);
  result.input = std::move(header);
  result.outputs = ListOutputs(own, result.input);
  result.warnings = FindWarningsOfRequest(own, result.input);
  tasks = ListTasks(own, result.input);
  products = MakeProducts(own, result.input);
}

template <typename TOptions>
Job::Job(const TOptions & wanted)
  : Job(wanted, ReadCheckedHeader(wanted))
{
  if constexpr (std::is_same_v<TOptions, ExtractOptions>)
  {
    result.segments = ChooseSegments(std::get<ExtractOptions>(command), result);
    CheckOtherInput(result.outputs, wanted.segmentFile);
  }
}

template Job::Job(const ExtractOptions &);
template Job::Job(const DistanceOptions &);
template Job::Job(const PartOptions &);
template Job::Job(const ExtractOptions &, VolumeHeader);

Footprint
Job::GetFootprint(const bool isShared) const
{
  Footprint footprint;
  footprint.grid = GetGrid(result.input);
  for (const JobTask & task : tasks)
  {
    footprint.engines.push_back({ task.filler, MakeEngineSettings(result.input, task.task) });
    footprint.keepsGrayValues |= task.keepsGrayValues;
  }
  JobRun::AddTo(footprint, *this);
  for (const auto & product : products)
  {
    product->AddTo(footprint, result.input);
  }
  footprint.beside += isShared ? footprint.saving : 0;
  return footprint;
}

void
Job::Plan(const bool isShared)
{
  const Footprint footprint = this->GetFootprint(isShared);
  if (!options.logFile.empty())
  {
    result.outputs.push_back({ "log", options.logFile, std::nullopt, true });
  }
  CheckOutputs(result.outputs, result.input, options.overwrite);
  for (const OutputRequest & output : result.outputs)
  {
    if (output.layout)
    {
      CheckOutputFormat(output.fileName, result.input.geometry, *output.layout, options.compression);
    }
  }
  std::error_code error;
  if (!options.scratchFolder.empty() && !std::filesystem::is_directory(options.scratchFolder, error))
  {
    Fail(ExitStatus::Refused, options.scratchFolder, ": the scratch folder does not exist");
  }
  result.plan = MakePlan(options, result.input, result.outputs, footprint);
  if (!options.dryRun)
  {
    RemoveLeftovers(result.outputs); // before space is taken for the new ones
  }
  PrepareProcess(result.plan);
}

void
Job::PlanProcess()
{
  result.plan = FitToMemory(options, result.input, this->GetFootprint(true));
  PrepareProcess(result.plan);
}

void
Job::Open(const ProgressSink & sink)
{
  result.input = UnpackVolume(result.input, result.plan.scratchFolder, sink);
  MeasureThreshold(options, result.input, sink);
  std::visit([](const auto & own) { CheckOptions(own); }, command); // with the threshold of Otsu
  result.otsu = options.lowerIsOtsu ? options.lowerThreshold : std::nullopt;
}

void
Job::CheckValues(ProgressSink & sink)
{
  const auto walls = this->GetWalls();
  if (options.lowerThreshold || options.upperThreshold || options.label || (walls && walls->labels))
  {
    return;
  }
  const std::size_t told = result.warnings.size();
  ApplyValueRules(result.warnings, MeasureSomeValues(result.input));
  TellWarnings(sink, result.warnings, told);
}

std::unique_ptr<InputVolume>
Job::OpenVolume() const
{
  const auto walls = this->GetWalls();
  if (walls && walls->labels)
  {
    const auto poreSize = GetParameters(*walls, GetGrid(result.input)).maximumPoreSize;
    return std::make_unique<LabelMap>(result.input, *walls->labels, poreSize, result.plan.memory.toKeep);
  }
  const Smoothing smoothing = walls ? GetSmoothing(*walls) : Smoothing::Off;
  auto            opened = std::make_unique<InputVolume>(result.input, options, result.plan.memory.toKeep, smoothing);
  opened->UseSmoothingLevel(walls ? walls->smoothingLevel : std::nullopt);
  const itk::MedialVoxelGrid grid = GetGrid(result.input);
  const auto * const         surface = std::get_if<PartOptions>(&command);
  const bool hasSheet = surface == nullptr || surface->localThicknessMethod == LocalThicknessMethod::Wall;
  if (const auto maximum = walls && hasSheet ? GetDefaultMaximumThickness(*walls, grid) : std::nullopt)
  {
    opened->LookForThickWalls(grid, *maximum);
  }
  return opened;
}

void
Job::Prepare(ProgressSink & sink)
{
  constexpr double share = 0.3;
  volume = this->OpenVolume();
  volume->Prepare([this, &sink](double fraction) {
    shareOfPreparation = share;
    sink.Report(share * fraction);
    ThrowIfStopRequested(sink);
  });
  if (const std::optional<double> maximum = volume->GetNeededMaximum())
  {
    this->UseMaximum(*maximum);
  }
}

void
Job::UseMaximum(double maximum)
{
  options.neededMaximum = maximum;
  std::visit(
    [this](const auto & own) {
      tasks = ListTasks(own, result.input);
      products = MakeProducts(own, result.input);
    },
    command);
}

void
Job::Measure(const ReadObserver & observer)
{
  result.roughness = volume->GetRoughness();
  result.smoothingLevel = volume->GetSmoothingLevel();
  if (const auto walls = this->GetWalls())
  {
    result.wallMeasure =
      walls->measure ? walls->measure : FindWallMeasure(*volume, result.input, *walls, result.plan.threads, observer);
  }
}

double
Job::GetShareOfEnd() const
{
  double share = 0.0;
  for (const auto & product : products)
  {
    share = std::max(share, product->GetShareOfEnd());
  }
  return share;
}

void
Job::Finish(OutputSet & outputs, ProgressSink & sink, const JobEnd & end)
{
  const std::size_t told = result.warnings.size();
  double            done = 0.0;
  const ProductEnd  complete{ outputs, end.input, [&, share = this->GetShareOfEnd()](const double fraction) {
                              ThrowIfStopRequested(sink);
                              if (share > 0.0 && fraction > done)
                              {
                                done = std::min(fraction, 1.0);
                                sink.Report(1.0 - share + share * done);
                              }
                            } };
  for (const auto & product : products)
  {
    product->FillVolumes(result, complete);
  }
  outputs.FinishVolumes();
  for (const auto & product : products)
  {
    product->Complete(result, complete);
  }
  ThrowIfStopRequested(sink);
  end.recordCosts();
  for (const auto & product : products)
  {
    product->Describe(result);
  }
  for (const auto & product : products)
  {
    product->WriteFile(result);
  }
  end.publish();
  if (result.plan.memory.unpacked > 0)
  {
    sink.Note(result.input.fileName.string() +
              " is compressed and was unpacked once: " + DescribeUnpacking(result.plan));
  }
  TellWarnings(sink, result.warnings, told);
}

std::optional<ExtractOptions>
Job::GetWalls() const
{
  const auto * const surface = std::get_if<PartOptions>(&command);
  const auto * const extract = std::get_if<ExtractOptions>(&command);
  return surface   ? std::optional<ExtractOptions>(GetThicknessOptions(*surface))
         : extract ? std::optional<ExtractOptions>(*extract)
                   : std::nullopt;
}

const char *
Job::GetTitle() const
{
  return std::holds_alternative<ExtractOptions>(command)    ? "extracting medial voxels"
         : std::holds_alternative<DistanceOptions>(command) ? "computing vector distances"
                                                            : "building the surface of the part";
}

} // end namespace medialvoxel
