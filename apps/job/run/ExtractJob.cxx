// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "ExtractParts.h"
#include "ExtractRun.h"
#include "ExtractSummary.h"
#include "FinishJob.h"
#include "JobClock.h"
#include "MemoryPlan.h"
#include "ObjectRule.h"
#include "OutputChecks.h"
#include "OptionChecks.h"
#include "Outputs.h"
#include "PageView.h"
#include "PipelineErrors.h"
#include "PrepareJob.h"
#include "Preview.h"
#include "ReadVolumeHeader.h"
#include "SegmentFiles.h"
#include "ScanMeasure.h"
#include "StopListener.h"
#include "SurfaceMesh.h"
#include "SurfacePlacement.h"
#include "SurfaceRemeshing.h"
#include "Text.h"
#include "ThicknessPreview.h"
#include "VolumeFormats.h"
#include "VolumeJob.h"
#include "VolumeStatistics.h"
#include "Warnings.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace medialvoxel
{
namespace
{

void
CheckFormats(const ExtractOptions & options)
{
  CheckExtensions(options);
  if (!options.meshFile.empty())
  {
    GetSurfaceFormat(options.meshFile);
  }
  if (!options.output.empty() || options.meshFile.empty())
  {
    FindOutputFormat(options.output);
  }
}

/** Outputs and options that are nothing without fits to gray values. */
bool
NeedsFits(const ExtractOptions & options)
{
  return !options.uncertaintyFile.empty() || options.levels;
}

/** \throw JobError Usage when there is no threshold that the values could be measured at. */
void
CheckGrayValues(const ExtractOptions & options, const VolumeHeader & header)
{
  if (NeedsFits(options) && !HasOneThreshold(options, header))
  {
    Fail(ExitStatus::Usage,
         options.levels ? "levels of gray values" : "the uncertainty of the thickness",
         " need one threshold, --lower or --upper, that values of the type ",
         std::string(GetTraits(header.GetValueType()).name),
         " reach");
  }
}

/** What the page takes beside the picture. Pictures of few colors pack to less than half a byte per pixel, which the
 * page has as text, also while it grows. */
constexpr std::uint64_t PageBytesPerPixel = 3;

void
AddSmoothing(PieceFootprint & footprint, const ExtractOptions & options, const VolumeHeader & header)
{
  if (GetSmoothing(options) == Smoothing::Off)
  {
    return;
  }
  std::uint64_t & bytes = InputVolume::IsReadInParallel(header) ? footprint.bytesPerThread : footprint.bytesBeside;
  bytes += InputVolume::GetBytesToSmooth(header);
}

PieceFootprint
GetFootprint(const ExtractOptions & options, const VolumeHeader & header)
{
  const auto     volumes = ListVolumes(options, header);
  PieceFootprint footprint;
  const auto     further = ListFurtherTasks(options, header);
  footprint.bytesPerVoxel = GetBytesPerVoxel(volumes, VolumeFiller::Extraction);
  for (const FurtherTask & task : further)
  {
    footprint.bytesPerVoxel = std::max(footprint.bytesPerVoxel, GetBytesPerVoxel(volumes, task.filler));
  }
  footprint.grid = GetGrid(options, header);
  const SurveyRequest        surveys = GetSurveyRequest(options);
  itk::MedialVoxelExtraction extraction = MakeExtraction(options, header);
  extraction.isObserved = true;
  extraction.observerBytesPerVoxel =
    Survey::WorkerBytesPerVoxel + (surveys.sheet ? SheetSurvey::WorkerBytesPerVoxel : 0);
  footprint.bytesBeside += Surveys::GetBytes(header.geometry, surveys);
  if (ListsPlaces(options))
  {
    extraction.observerBytesPerVoxel += PlaceSurvey::WorkerBytesPerVoxel;
    // A slice in one wall has many cells at once: half of what is left beside the walls themselves.
    footprint.surplus = {
      PlaceSurvey::MostBytesPerVoxel, PlaceSurvey::PlannedBytesPerVoxel, PlaceSurvey::MostBytesPerVoxelOfSlice, 2
    };
  }
  AddSmoothing(footprint, options, header);
  if (!options.meshFile.empty())
  {
    extraction.observerBytesPerVoxel +=
      itk::MedialVoxelSurfaceObserver::GetWorkerBytesPerVoxel(footprint.grid, extraction.parameters);
    footprint.bytesBeside += SurfaceMesh::GetBytes(options, header.geometry);
    footprint.surplus.mostBytesPerVoxel += SurfaceMesh::MostBytesPerVoxel;
    footprint.surplus.plannedBytesPerVoxel += SurfaceMesh::PlannedBytesPerVoxel;
    footprint.scratch = SurfaceMesh::GetScratchSpace(options, header.geometry);
  }
  if (options.labels)
  {
    footprint.bytesPerVoxel += footprint.bytesPerVoxel + itk::MedialVoxelObjectUnion::BytesPerVoxel;
    footprint.bytesBeside += LabelMapRun::GetPlannedBytes(*options.labels);
    footprint.bytesBeside += itk::MedialVoxelObjectAdjacency::GetBytes(
      footprint.grid.GetSize(), GetParameters(options, footprint.grid).maximumPoreSize);
  }
  AddEngine(footprint, header, extraction);
  AddOutputs(footprint, options, header, ListOutputs(options, header));
  for (const FurtherTask & task : further)
  {
    AddEngine(footprint, header, task.task);
  }
  if (surveys.survey.picture)
  {
    footprint.bytesBeside += GetPreviewBytes(header.geometry);
    footprint.bytesBeside += options.thicknessFile.empty() ? 0 : GetThicknessPreviewBytes(header.geometry);
  }
  if (!options.htmlFile.empty())
  {
    const PreviewLayout layout = ArrangePreview(header.geometry);
    const unsigned int  pictures = options.thicknessFile.empty() ? 1 : 2;
    footprint.bytesBeside +=
      pictures * PageBytesPerPixel * layout.width * layout.height + GetPageViewBytes(header.geometry);
  }
  return footprint;
}

/** Of a process that works on a part, whose surveys it saves. */
PieceFootprint
GetSharedFootprint(const ExtractOptions & options, const VolumeHeader & header)
{
  PieceFootprint footprint = GetFootprint(options, header);
  footprint.bytesBeside += Surveys::GetSavedBytes(header.geometry, GetSurveyRequest(options));
  return footprint;
}

/** Chunks are read and written in any order. Surfaces, objects and further tasks are made of whole slices. */
bool
CanDoRows(const ExtractOptions & options, const VolumeHeader & header)
{
  return header.GetStored().chunks && !header.stored && options.meshFile.empty() && !options.labels &&
         ListFurtherTasks(options, header).empty();
}

/** Names and colors of the labels that the options choose. */
SegmentTable
FindSegments(const ExtractOptions & options, const VolumeHeader & header)
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
    options.segmentFile.empty() ? ReadSegmentsOfVolume(header) : ReadSegments(options.segmentFile);
  SegmentTable selected = SelectSegments(all, ResolveNames(*options.labels, all));
  CheckSegments(options.objectFile, selected);
  return selected;
}

void
NameObjects(JobResult & result)
{
  for (std::size_t i = 0; !result.objects.is_null() && i < result.objects["objects"].size(); ++i)
  {
    Json & object = result.objects["objects"][i];
    if (const Segment * const segment = result.segments.Find(object["label"]))
    {
      object["name"] = segment->name.empty() ? Json(nullptr) : Json(segment->name);
      object["color"] = segment->color ? Json(*segment->color) : Json(nullptr);
    }
  }
}

/** The part of the job that has the volume open. */
class Extraction
{
public:
  Extraction(const ExtractOptions & options, JobResult & result, ProgressSink & sink)
    : m_Result(result)
    , m_Sink(sink)
    , m_Outputs(options, result.plan.writesBehind)
    , m_Run(options, result, sink)
  {
    for (VolumeRequest & request : ListVolumes(options, result.input))
    {
      request.layout.segments = request.filler == VolumeFiller::Objects ? &result.segments : nullptr;
      m_Run.AddVolume(request, m_Outputs.AddVolume(request));
    }
    m_MeshFile = m_Outputs.AddFile(options.meshFile);
    m_Summary = std::make_unique<ExtractSummary>(options, m_Run.GetSurveys(), m_Outputs);
    if (m_MeshFile)
    {
      m_Mesh = std::make_unique<SurfaceMesh>(
        options, result.input.geometry, GetGrid(options, result.input), GetSurplusShare(options, result.plan));
      m_Run.AddMesh(*m_Mesh);
    }
  }

  void
  Run(JobClock::time_point start)
  {
    m_Run.Prepare();
    m_Result.roughness = m_Run.GetInput().GetRoughness();
    m_Result.wallMeasure = m_Run.GetMeasure();
    this->PlanObjects();
    for (std::uint64_t piece = 0; piece < m_Result.plan.divisions; ++piece)
    {
      m_Result.sums += m_Run.Run(m_Result.plan.GetPiece(piece), m_Result.plan.GetNextPiece(piece));
    }
    m_Run.Wait();
    m_Result.objects = m_Run.SummarizeObjects();
    NameObjects(m_Result);
    CheckCounts(m_Result.sums.counts);
    const auto finishStart = JobClock::now();
    JobEnd     end;
    end.complete = [this] { this->WriteMesh(); };
    end.recordCosts = [this, start, finishStart] {
      m_Result.seconds.remeshing = m_Result.surface ? m_Result.surface->remeshingSeconds : 0.0;
      const double writing = m_Run.GetWriteSeconds() + SecondsSince(finishStart) - m_Result.seconds.remeshing;
      AddMeasurements(m_Result, m_Run.GetInput(), writing, start);
    };
    FinishJob(m_Outputs, *m_Summary, m_Result, m_Sink, end);
  }

private:
  /** The number of objects of a label map is known once it is prepared. */
  void
  PlanObjects()
  {
    JobPlan &           plan = m_Result.plan;
    const std::uint64_t bytes = m_Run.GetUnplannedBytes();
    if (bytes > plan.memoryLimit - std::min(plan.memoryLimit, plan.memoryBytes))
    {
      Fail(ExitStatus::Refused,
           m_Result.input.fileName.string(),
           ": its objects take ",
           FormatBytes(bytes),
           " of memory beside the ",
           FormatBytes(plan.memoryBytes),
           " that are planned, ",
           FormatBytes(plan.memoryLimit),
           " are allowed; allow more with --memory, or name fewer objects with --labels");
    }
    if (bytes > 0)
    {
      plan.fixedBytes += bytes;
      plan.memoryBytes += bytes;
      m_Run.SetPlan(plan);
    }
  }

  void
  WriteMesh()
  {
    if (m_Mesh)
    {
      // The mesh takes the memory of the windows and results.
      m_Run.DropEngines();
      m_Mesh->FindEdgesWith(m_Run.MakeRimRays());
      const JobPlan & plan = m_Result.plan;
      m_Result.surface = m_Mesh->Write(*m_MeshFile,
                                       plan.memoryLimit - std::min(plan.memoryLimit, plan.fixedBytes),
                                       plan.threads,
                                       [this](double) { m_Run.ThrowIfStopRequested(); });
    }
  }

  JobResult &                     m_Result;
  ProgressSink &                  m_Sink;
  OutputSet                       m_Outputs;
  OutputFile *                    m_MeshFile{ nullptr };
  std::unique_ptr<ExtractSummary> m_Summary;
  std::unique_ptr<SurfaceMesh>    m_Mesh;
  ExtractRun                      m_Run; // ends before what it writes to and who observes it
};

} // namespace

SurveyRequest
GetSurveyRequest(const ExtractOptions & options)
{
  SurveyRequest surveys;
  surveys.survey.picture = !options.previewFile.empty() || !options.htmlFile.empty();
  surveys.sheet = !options.htmlFile.empty() && HasPageViewer();
  for (const auto & [kind, limits] :
       { std::pair(PlaceKind::Thin, options.thinBelow), std::pair(PlaceKind::Thick, options.thickAbove) })
  {
    if (limits)
    {
      surveys.places.limits[kind] = *limits;
    }
  }
  surveys.places.smallestArea = options.smallestPlace;
  return surveys;
}

std::uint64_t
GetSurplusShare(const ExtractOptions & options, const JobPlan & plan)
{
  const bool isShared = ListsPlaces(options) && !options.meshFile.empty();
  return isShared ? plan.surplusBytes / 2 : plan.surplusBytes;
}

void
CheckCounts(const itk::MedialVoxelCounts & counts)
{
  const std::uint64_t decided =
    counts.trivialCells + counts.boundCells + counts.geodesicMedialCells + counts.geodesicNonMedialCells;
  if (decided != counts.candidateCells)
  {
    Fail(ExitStatus::Failure, counts.candidateCells, " cells were to be decided, ", decided, " were");
  }
}

JobResult
DescribeExtract(const ExtractOptions & options)
{
  JobResult result;
  result.input = ReadSheetInputHeader(options);
  result.outputs = ListOutputs(options, result.input);
  result.warnings = FindWarningsOfRequest(options, result.input);
  return result;
}

namespace
{

template <typename TGetFootprint>
JobResult
Prepare(const ExtractOptions & options, const TGetFootprint & getFootprint)
{
  CheckOptions(options);
  CheckFormats(options);
  VolumeHeader header = ReadSheetInputHeader(options);
  if (!options.meshFile.empty())
  {
    CheckSurfaceInput(header, options.meshFile, "medial surface");
    CheckElementSize(options, header.geometry);
  }
  CheckGrayValues(options, header);
  CheckLabel(options, header);
  auto outputs = ListOutputs(options, header);
  auto footprint = getFootprint(options, header);
  footprint.preferredRows = CanDoRows(options, header) ? GetRowsOfLayer(header, outputs) : 0;
  auto segments = FindSegments(options, header);
  CheckOtherInput(outputs, options.segmentFile);
  JobResult result = PrepareJob(options, std::move(header), std::move(outputs), footprint);
  result.segments = std::move(segments);
  result.warnings = FindWarningsOfRequest(options, result.input);
  return result;
}

} // namespace

JobResult
PrepareExtract(const ExtractOptions & options)
{
  return Prepare(options, GetFootprint);
}

JobResult
PrepareProcesses(const ExtractOptions & options)
{
  return Prepare(options, GetSharedFootprint);
}

JobPlan
PlanObjects(const ExtractOptions & options, const VolumeHeader & header)
{
  return FitToMemory(options, header, GetFootprint(options, header));
}

JobResult
PrepareSharedExtract(const ExtractOptions & options)
{
  JobResult job = DescribeExtract(options);
  job.plan = FitToMemory(options, job.input, GetSharedFootprint(options, job.input));
  PrepareProcess(job.plan);
  return job;
}

JobResult
RunExtract(const ExtractOptions & options, ProgressSink & sink)
{
  const auto start = JobClock::now();
  JobResult  result = PrepareExtract(options);
  TellWarnings(sink, result.warnings);
  if (options.dryRun)
  {
    return result;
  }
  ExtractOptions own = options;
  if (own.labels)
  {
    own.labels = ResolveNames(*options.labels, result.segments);
  }
  result.input = UnpackInput(result.input, result.plan, sink);
  MeasureThreshold(own, result.input, sink);
  CheckOptions(own); // with the threshold of Otsu
  result.otsu = own.lowerIsOtsu ? own.lowerThreshold : std::nullopt;
  WithPipelineErrors([&] {
    sink.Start("medialvoxel", "extracting medial voxels");
    const StopListener listener(&sink);
    Extraction         extraction(own, result, sink);
    extraction.Run(start);
  });
  sink.Finish(result.seconds.total);
  return result;
}

} // end namespace medialvoxel
