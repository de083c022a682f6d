// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HtmlReport.h"
#include "JobParts.h"
#include "OutputSet.h"
#include "Preview.h"
#include "Report.h"
#include "ReturnParameters.h"
#include "SurfaceMesh.h"
#include "Survey.h"
#include "Text.h"
#include "ThicknessPreview.h"
#include "TileObservers.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace medialvoxel
{
namespace
{

/** \throw JobError Usage when a file has a name that does not say what will be in it. */
void
CheckExtension(const std::string & fileName, const std::vector<std::string> & allowed, const char * what)
{
  const std::string extension = ToLower(std::filesystem::path(fileName).extension().string());
  if (!fileName.empty() && std::find(allowed.begin(), allowed.end(), extension) == allowed.end())
  {
    Fail(ExitStatus::Usage,
         fileName,
         ": unknown format '",
         extension,
         "'; the ",
         what,
         " is written as ",
         Join(allowed, " or ", [](const std::string & name) { return name; }));
  }
}

void
CheckFormats(const ExtractOptions & options)
{
  CheckExtension(options.thicknessCsvFile, { ".csv" }, "histogram");
  CheckExtension(options.previewFile, { ".png" }, "preview");
  CheckExtension(options.htmlFile, { ".html", ".htm" }, "page");
  if (!options.meshFile.empty())
  {
    GetSurfaceFormat(options.meshFile);
  }
  if (!options.output.empty() || options.meshFile.empty())
  {
    GetVolumeFormat(options.output);
  }
}

/** \throw JobError Refused when the values are to be measured on but are read only once, for the mask. */
void
CheckGrayValues(const ExtractOptions & options, const VolumeHeader & header)
{
  if (options.subVoxel && !header.CanStream())
  {
    Fail(ExitStatus::Refused,
         header.fileName.string(),
         ": the sub-voxel thickness needs values that can be read in pieces, but the file is read once, to a mask (",
         header.DescribeReading(),
         "); unpack it first");
  }
}

SurveySettings
GetSurveySettings(const ExtractOptions & options)
{
  SurveySettings settings;
  settings.picture = !options.previewFile.empty() || !options.htmlFile.empty();
  const bool showsAll = !options.thicknessFile.empty() || !options.thicknessCsvFile.empty();
  settings.thickness = showsAll || !options.reportFile.empty() || !options.htmlFile.empty();
  if (showsAll)
  {
    settings.fullyMeasuredVoxels = std::numeric_limits<std::uint64_t>::max();
  }
  return settings;
}

/** What the page takes beside the picture. Pictures of few colors pack to less than half a byte per pixel, which the
 * page has as text, also while it grows. */
constexpr std::uint64_t PageBytesPerPixel = 3;

std::vector<OutputRequest>
ListCandidates(const ExtractOptions & options, const VolumeHeader & header)
{
  return { { "labels", options.output, LabelLayout },
           { "vectors", options.vectorFile, GetVectorLayout(header) },
           { "distance", options.distanceFile, DistanceLayout },
           { "thickness_map", options.thicknessFile, ThicknessLayout },
           { "thickness_csv", options.thicknessCsvFile, std::nullopt },
           { "mesh", options.meshFile, std::nullopt },
           { "preview", options.previewFile, std::nullopt },
           { "html", options.htmlFile, std::nullopt },
           { "report", options.reportFile, std::nullopt },
           { "return_parameters", options.returnParameterFile, std::nullopt } };
}

/** Labels, vectors and thicknesses of a piece are kept together, and after them vectors and distances. */
PieceFootprint
GetFootprint(const ExtractOptions & options, const VolumeHeader & header)
{
  const std::uint64_t vectorBytes = GetVectorLayout(header).GetBytes();
  const std::uint64_t labels = LabelLayout.GetBytes() + (options.vectorFile.empty() ? 0 : vectorBytes) +
                               (options.thicknessFile.empty() ? 0 : ThicknessLayout.GetBytes());
  const std::uint64_t distances = options.distanceFile.empty() ? 0 : vectorBytes + DistanceLayout.GetBytes();
  PieceFootprint      footprint;
  footprint.bytesPerVoxel = std::max(labels, distances);
  footprint.grid = GetGrid(options, header);
  const bool withObjectVectors =
    !options.vectorFile.empty() && options.vectorBoundary == itk::MedialVoxelBoundary::Object;
  auto settings = itk::MedialVoxelClusterEngine::Settings::ForClassification(
    footprint.grid, GetParameters(options, footprint.grid), withObjectVectors);
  const SurveySettings survey = GetSurveySettings(options);
  if (survey.thickness || survey.picture)
  {
    settings.workerBytesPerVoxel += itk::MedialVoxelTileWallsBytesPerVoxel;
    settings.keepsGray = options.subVoxel;
  }
  footprint.bytesBeside += Survey::GetBytes(header.geometry, survey);
  if (!options.meshFile.empty())
  {
    settings.workerBytesPerVoxel +=
      itk::MedialVoxelSurfaceObserver::GetWorkerBytesPerVoxel(GetParameters(options, footprint.grid));
    footprint.bytesBeside += SurfaceMesh::GetBytes(options, header.geometry);
  }
  AddEngine(footprint, header, settings);
  AddOutputs(footprint, options, header, ListCandidates(options, header));
  if (!options.distanceFile.empty())
  {
    AddEngine(
      footprint, header, itk::MedialVoxelClusterEngine::Settings::ForDistances(itk::MedialVoxelBoundary::Object));
  }
  if (survey.picture)
  {
    footprint.bytesBeside += GetPreviewBytes(header.geometry);
    footprint.bytesBeside += options.thicknessFile.empty() ? 0 : GetThicknessPreviewBytes(header.geometry);
  }
  if (!options.htmlFile.empty())
  {
    const PreviewLayout layout = ArrangePreview(header.geometry);
    const unsigned int  pictures = options.thicknessFile.empty() ? 1 : 2;
    footprint.bytesBeside += pictures * PageBytesPerPixel * layout.width * layout.height;
  }
  return footprint;
}

/** Each cell must have been decided once. */
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

/** The part of the job that has the volume open. */
class Extraction
{
public:
  Extraction(const ExtractOptions & options, JobResult & result, ProgressSink & sink)
    : m_Options(options)
    , m_Result(result)
    , m_Input(OpenInputVolume(result.input, options, result.plan.scratchFolder))
    , m_Loop(result.plan, result.input, options.distanceFile.empty() ? 1 : 2, sink)
    , m_Runner(MakeExtractRunner(*m_Input, result.input, options, GetCutSettings(result.plan), m_Loop.GetObserver()))
    , m_Survey(result.input.geometry, GetGrid(options, result.input), GetSurveySettings(options))
    , m_Outputs(options, result.plan.writesBehind)
    , m_Writer(result.plan.writesBehind)
  {
    const VolumeGeometry & geometry = result.input.geometry;
    m_Labels = m_Outputs.AddVolume(options.output, m_Runner->GetGeometry(), LabelLayout);
    m_Vectors = m_Outputs.AddVolume(options.vectorFile, geometry, GetVectorLayout(result.input));
    m_Distances = m_Outputs.AddVolume(options.distanceFile, geometry, DistanceLayout);
    m_Thicknesses = m_Outputs.AddVolume(options.thicknessFile, m_Runner->GetGeometry(), ThicknessLayout);
    m_ThicknessCsv = m_Outputs.AddFile(options.thicknessCsvFile);
    m_MeshFile = m_Outputs.AddFile(options.meshFile);
    m_Preview = m_Outputs.AddFile(options.previewFile);
    m_Html = m_Outputs.AddFile(options.htmlFile);
    m_Report = m_Outputs.AddFile(options.reportFile);
    m_ReturnParameters = m_Outputs.AddFile(options.returnParameterFile);
    if (m_MeshFile)
    {
      m_Mesh = std::make_unique<SurfaceMesh>(options, geometry, GetGrid(options, result.input));
      m_Observers.Add(m_Mesh->GetObserver());
    }
    if (m_Survey.GetSettings().thickness || m_Survey.GetSettings().picture)
    {
      m_Observers.Add(m_Survey);
    }
    if (!m_Observers.IsEmpty())
    {
      m_Runner->SetTileObserver(&m_Observers);
    }
    if (result.plan.writesBehind)
    {
      m_Runner->KeepPreviousResults();
    }
    if (m_Distances)
    {
      DistanceSettings settings;
      settings.generateDistance = true;
      settings.cut = GetCutSettings(result.plan);
      m_DistanceRunner = MakeDistanceRunner(*m_Input, result.input, options, settings, m_Loop.GetObserver());
    }
  }

  void
  Run(JobClock::time_point start)
  {
    m_Loop.Prepare(*m_Input);
    for (std::uint64_t piece = 0; piece < m_Result.plan.divisions; ++piece)
    {
      this->RunPiece(m_Result.plan.GetPiece(piece));
    }
    m_Writer.Wait();
    m_Result.sums = m_Runner->GetSums();
    if (m_DistanceRunner)
    {
      const RunnerSums distances = m_DistanceRunner->GetSums();
      m_Result.sums.distanceSeconds += distances.distanceSeconds;
      m_Result.sums.threadSeconds += distances.threadSeconds;
      m_Result.sums.tileSeconds += distances.tileSeconds;
      m_Result.sums.recomputedVoxels += distances.recomputedVoxels;
    }
    CheckCounts(m_Result.sums.counts);
    this->Finish(start);
  }

private:
  void
  RunPiece(const SliceRange & piece)
  {
    m_Loop.Run(*m_Runner, piece, m_Writer, [this](const PieceLoop::Range & range, const PieceResults & results) {
      if (results.isEmpty && m_Options.sparse)
      {
        return;
      }
      if (m_Labels)
      {
        m_Labels->Write(range.firstVoxel, range.numberOfVoxels, results.labels);
      }
      if (m_Vectors)
      {
        m_Vectors->Write(range.firstVoxel, range.numberOfVoxels, results.vectors);
      }
      if (m_Thicknesses)
      {
        m_Thicknesses->Write(range.firstVoxel, range.numberOfVoxels, results.thicknesses);
      }
    });
    if (m_DistanceRunner)
    {
      m_Loop.Run(
        *m_DistanceRunner, piece, m_Writer, [this](const PieceLoop::Range & range, const PieceResults & results) {
          m_Distances->Write(range.firstVoxel, range.numberOfVoxels, results.distances);
        });
    }
  }

  void
  Finish(JobClock::time_point start)
  {
    const auto finishStart = JobClock::now();
    m_Outputs.FinishVolumes();
    const Pictures pictures = this->MakePictures();
    if (m_Mesh)
    {
      m_Result.surface = m_Mesh->Write(*m_MeshFile, [this](double) { m_Loop.ThrowIfStopRequested(); });
    }
    m_Loop.ThrowIfStopRequested();
    AddMeasurements(m_Result, *m_Input, m_Writer.GetSeconds() + SecondsSince(finishStart), start);
    if (m_Survey.GetSettings().thickness)
    {
      m_Result.thickness =
        Summarize(m_Survey.GetThickness(), m_Survey.GetThicknessByArea(), m_Survey.GetAreaUnit(), m_Survey.GetStep());
    }
    if (m_ThicknessCsv)
    {
      WriteText(*m_ThicknessCsv,
                MakeThicknessCsv(m_Survey.GetThickness(), m_Survey.GetThicknessByArea(), m_Survey.GetAreaUnit()));
    }
    if (m_Html)
    {
      WriteText(*m_Html, MakeHtmlReport(m_Options, m_Result, pictures));
    }
    if (m_Report)
    {
      WriteText(*m_Report, MakeReport(m_Options, m_Result));
    }
    if (m_ReturnParameters)
    {
      WriteText(*m_ReturnParameters, MakeReturnParameters(m_Result));
    }
    m_Outputs.Publish();
  }

  /** Writes the preview; returns the pictures of a page, as the bytes of files. */
  Pictures
  MakePictures()
  {
    Pictures pictures;
    if (!m_Preview && !m_Html)
    {
      return pictures;
    }
    const VolumeGeometry & geometry = m_Result.input.geometry;
    const Canvas           labels = DrawPreview(*m_Labels, geometry, m_Survey);
    pictures.labels = labels.EncodePng();
    std::string preview = pictures.labels;
    if (m_Thicknesses)
    {
      const Canvas thicknesses =
        DrawThicknessPreview(*m_Labels, *m_Thicknesses, geometry, m_Survey, m_Options.voxelUnits ? "VOXELS" : "UNITS");
      pictures.thicknesses = thicknesses.EncodePng();
      preview = JoinCanvases(labels, thicknesses).EncodePng();
    }
    if (m_Preview)
    {
      WriteText(*m_Preview, preview);
    }
    return pictures;
  }

  const ExtractOptions &       m_Options;
  JobResult &                  m_Result;
  std::unique_ptr<InputVolume> m_Input;
  PieceLoop                    m_Loop;
  std::unique_ptr<PieceRunner> m_Runner;
  std::unique_ptr<PieceRunner> m_DistanceRunner;
  Survey                       m_Survey;
  std::unique_ptr<SurfaceMesh> m_Mesh;
  TileObservers                m_Observers;
  OutputSet                    m_Outputs;
  VoxelOutput *                m_Labels{ nullptr };
  VoxelOutput *                m_Vectors{ nullptr };
  VoxelOutput *                m_Distances{ nullptr };
  VoxelOutput *                m_Thicknesses{ nullptr };
  OutputFile *                 m_ThicknessCsv{ nullptr };
  OutputFile *                 m_MeshFile{ nullptr };
  OutputFile *                 m_Preview{ nullptr };
  OutputFile *                 m_Html{ nullptr };
  OutputFile *                 m_Report{ nullptr };
  OutputFile *                 m_ReturnParameters{ nullptr };
  WriteBehind                  m_Writer; // ends before what it writes and where to
};

} // namespace

JobResult
RunExtract(const ExtractOptions & options, ProgressSink & sink)
{
  const auto start = JobClock::now();
  CheckOptions(options);
  CheckFormats(options);
  VolumeHeader header = ReadVolumeHeader(options.input, options.raw);
  if (!options.meshFile.empty())
  {
    CheckSurfaceInput(header);
  }
  CheckGrayValues(options, header);
  const auto candidates = ListCandidates(options, header);
  const auto footprint = GetFootprint(options, header);
  JobResult  result = PrepareJob(options, std::move(header), candidates, footprint);
  if (options.dryRun)
  {
    return result;
  }
  WithPipelineErrors([&] {
    sink.Start("medialvoxel", "extracting medial voxels");
    Extraction extraction(options, result, sink);
    extraction.Run(start);
  });
  sink.Finish(result.seconds.total);
  return result;
}

} // end namespace medialvoxel
