// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ExtractRun.h"

#include "ExtractParts.h"
#include "Outputs.h"
#include "LabelMap.h"
#include "RimRays.h"
#include "ScanMeasure.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace medialvoxel
{

itk::MedialVoxelExtraction
MakeExtraction(const ExtractOptions & options, const VolumeHeader & header)
{
  itk::MedialVoxelExtraction extraction;
  extraction.parameters = GetParameters(options, GetGrid(options, header));
  extraction.measuresThickness = MeasuresWalls(options);
  if (!options.vectorFile.empty())
  {
    extraction.vectorBoundary = options.vectorBoundary;
  }
  if (MayMeasureOnGrayValues(options, header))
  {
    extraction.grayRange = GetGrayRange(options, header);
  }
  return extraction;
}

std::vector<FurtherTask>
ListFurtherTasks(const ExtractOptions & options, const VolumeHeader & header)
{
  std::vector<FurtherTask> tasks;
  if (!options.distanceFile.empty())
  {
    itk::MedialVoxelDistanceMap task;
    task.findsDisplacements = false;
    tasks.push_back({ VolumeFiller::Distance, task });
  }
  if (!options.localThicknessFile.empty())
  {
    auto task = GetLocalThickness(options, GetGrid(options, header));
    if (task.walls && MayMeasureOnGrayValues(options, header))
    {
      task.walls->grayRange = GetGrayRange(options, header);
    }
    tasks.push_back({ VolumeFiller::LocalThickness, task });
  }
  return tasks;
}

namespace
{

std::uint64_t
GetMaximumPoreSize(const ExtractOptions & options, const JobResult & job)
{
  return GetParameters(options, GetGrid(options, job.input)).maximumPoreSize;
}

std::unique_ptr<InputVolume>
OpenInput(const ExtractOptions & options, const JobResult & job)
{
  if (options.labels)
  {
    return std::make_unique<LabelMap>(
      job.input, *options.labels, GetMaximumPoreSize(options, job), job.plan.bytesToKeep);
  }
  return std::make_unique<InputVolume>(job.input, options, job.plan.bytesToKeep, GetSmoothing(options));
}

} // namespace

ExtractRun::ExtractRun(const ExtractOptions & options, const JobResult & job, ProgressSink & sink)
  : m_Options(options)
  , m_Header(job.input)
  , m_Input(OpenInput(options, job))
  , m_Loop(job.plan, job.input, 1 + static_cast<unsigned int>(ListFurtherTasks(options, job.input).size()), sink)
  , m_Surveys(job.input.geometry,
              GetGrid(options, job.input),
              GetSurveyRequest(options),
              GetSurplusShare(options, job.plan))
  , m_Labels(options.labels.value_or(LabelSelection{}))
  , m_Writer(job.plan.writesBehind)
{
  const auto makeEngine = [&](const itk::MedialVoxelEngineTask & task) {
    return std::make_unique<PieceEngine>(m_Input->GetInput(), job.input, options, job.plan, task, m_Loop.GetObserver());
  };
  m_Engine = makeEngine(MakeExtraction(options, job.input));
  if (job.plan.writesBehind)
  {
    m_Engine->KeepPreviousResults();
  }
  for (const FurtherTask & further : ListFurtherTasks(options, job.input))
  {
    m_FurtherEngines.push_back({ further.filler, makeEngine(further.task) });
  }
  if (options.labels)
  {
    m_Objects = std::make_unique<LabelMapRun>(static_cast<LabelMap &>(*m_Input).GetObjects(),
                                              job.input.geometry,
                                              GetMaximumPoreSize(options, job),
                                              m_Surveys.GetSurvey());
    m_Engine->AddObserver(m_Objects->GetObserver());
  }
}

void
ExtractRun::AddVolume(const VolumeRequest & request, VoxelOutput & volume)
{
  if (m_Objects)
  {
    m_Objects->AddVolume(request, volume);
    return;
  }
  this->GetEngine(request.filler).AddVolume(request, volume);
}

PieceEngine &
ExtractRun::GetEngine(const VolumeFiller filler)
{
  const auto found = std::find_if(
    m_FurtherEngines.begin(), m_FurtherEngines.end(), [&](const auto & further) { return further.filler == filler; });
  return found == m_FurtherEngines.end() ? *m_Engine : *found->engine;
}

void
ExtractRun::AddObserver(itk::MedialVoxelTileObserver & observer)
{
  m_Engine->AddObserver(observer);
}

void
ExtractRun::AddMesh(SurfaceMesh & mesh)
{
  this->AddObserver(mesh.GetObserver());
  if (m_Objects)
  {
    m_Objects->AddMesh(mesh);
  }
}

void
ExtractRun::SetSlicesToDo(std::uint64_t slices)
{
  m_Loop.SetSlicesToDo(slices);
}

void
ExtractRun::Prepare()
{
  m_Engine->AddObserver(m_Surveys.GetSurvey());
  if (PlaceSurvey * const places = m_Surveys.GetPlaces())
  {
    m_Engine->AddObserver(*places);
    m_Engine->AddRegionListener([places](const itk::MedialVoxelBox & region) { places->BeginRegion(region); });
  }
  if (SheetSurvey * const sheet = m_Surveys.GetSheet())
  {
    m_Engine->AddObserver(*sheet);
  }
  m_Loop.Prepare(*m_Input);
  this->ChooseMeasure();
  if (m_Objects)
  {
    m_Loop.SetRunsPerPiece(m_Objects->GetNumberOfPasses());
  }
}

void
ExtractRun::ChooseMeasure()
{
  m_Measure = m_Options.measure
                ? m_Options.measure
                : FindWallMeasure(*m_Input, m_Header, m_Options, [this](double) { m_Loop.ThrowIfStopRequested(); });
  const auto range = GetGrayRange(*m_Measure, m_Options, m_Header);
  m_Engine->SetGrayRange(range);
  for (const FurtherEngine & further : m_FurtherEngines)
  {
    further.engine->SetGrayRange(range);
  }
}

itk::MedialVoxelMeasureRimRays
ExtractRun::MakeRimRays() const
{
  if (m_Options.labels)
  {
    return {};
  }
  const auto range = m_Measure ? GetGrayRange(*m_Measure, m_Options, m_Header) : std::nullopt;
  const auto rays = std::make_shared<RimRays>(m_Input->GetInput(), m_Header.geometry, range);
  return [rays](const itk::MedialVoxelRimRays & bundle) { return rays->Measure(bundle); };
}

std::uint64_t
ExtractRun::GetUnplannedBytes() const
{
  return m_Objects ? LabelMapRun::GetUnplannedBytes(m_Labels, m_Objects->GetNumberOfObjects()) : 0;
}

void
ExtractRun::SetPlan(const JobPlan & plan)
{
  m_Loop.SetPlan(plan);
  m_Engine->SetMemoryLimit(plan.GetEngineLimit(plan.GetSlicesAtOnce()));
}

itk::MedialVoxelSums
ExtractRun::Run(const SliceRange & range, const SliceRange & nextRange)
{
  if (m_Objects)
  {
    return m_Objects->Run(m_Loop, *m_Engine, range, m_Writer);
  }
  itk::MedialVoxelSums sums = m_Loop.Run(*m_Engine, range, nextRange, m_Writer);
  for (const FurtherEngine & further : m_FurtherEngines)
  {
    itk::MedialVoxelSums others = m_Loop.Run(*further.engine, range, nextRange, m_Writer);
    others.counts = {};                                                         // of the same voxels
    others.distanceSeconds += std::exchange(others.classificationSeconds, 0.0); // no cells are decided
    sums += others;
  }
  return sums;
}

Json
ExtractRun::SummarizeObjects() const
{
  return m_Objects ? m_Objects->Summarize() : Json(nullptr);
}

void
ExtractRun::Wait()
{
  m_Writer.Wait();
}

void
ExtractRun::DropEngines()
{
  m_Engine.reset();
  m_FurtherEngines.clear();
}

void
ExtractRun::Release()
{
  m_Engine->Release();
  for (const FurtherEngine & further : m_FurtherEngines)
  {
    further.engine->Release();
  }
}

} // end namespace medialvoxel
