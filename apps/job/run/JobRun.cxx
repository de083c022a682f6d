// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobRun.h"

#include "Errors.h"
#include "LabelMap.h"
#include "ScanMeasure.h"
#include "Text.h"

#include "itkMedialVoxelWallBalls.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace medialvoxel
{
namespace
{

/** The local thickness of walls that a task finds, or null. */
template <typename TTask>
auto *
FindWallThickness(TTask & task)
{
  auto * const thickness = std::get_if<itk::MedialVoxelLocalThickness>(&task.task);
  return thickness != nullptr && thickness->walls ? thickness : nullptr;
}

bool
FindsWallsBefore(const Job & job)
{
  return job.tasks.front().filler == VolumeFiller::Extraction;
}

/** The balls that the extraction finds for the local thickness, if it follows one. */
std::shared_ptr<itk::MedialVoxelWallBalls>
MakeBalls(Job & job)
{
  std::shared_ptr<itk::MedialVoxelWallBalls> balls;
  for (JobTask & task : job.tasks)
  {
    auto * const thickness = FindWallThickness(task);
    if (thickness != nullptr && FindsWallsBefore(job))
    {
      thickness->balls = balls = std::make_shared<itk::MedialVoxelWallBalls>(GetGrid(job.result.input), *thickness);
    }
  }
  return balls;
}

} // namespace

JobRun::JobRun(Job & job, OutputSet & outputs, ProgressSink & sink)
  : m_Job(job)
  , m_Walls(job.GetWalls())
  , m_Input(job.volume.get())
  , m_Loop(job.result.plan, job.result.input, static_cast<unsigned int>(job.tasks.size()), sink)
  , m_Writer(job.result.plan.writesBehind)
{
  m_Loop.SetInput(*m_Input, job.shareOfPreparation, job.GetShareOfEnd());
  const JobResult & planned = job.result;
  const auto        balls = MakeBalls(job);
  for (const JobTask & task : job.tasks)
  {
    m_Engines.push_back(
      { task.filler,
        std::make_unique<PieceEngine>(
          m_Input->GetInput(), planned.input, job.options, planned.plan, task.task, m_Loop.GetObserver()) });
  }
  if (planned.plan.writesBehind)
  {
    m_Engines.front().engine->KeepPreviousResults();
  }
  if (balls)
  {
    m_SlicesOfBalls = balls->GetMargin();
    m_Engines.front().engine->AddObserver(*balls);
    m_Engines.front().engine->AddRegionListener(
      [balls](const itk::MedialVoxelBox & region) { balls->BeginRegion(region); });
  }
  ProductStart start{ planned, m_Input };
  for (const auto & product : job.products)
  {
    product->Start(start);
  }
  if (m_Walls && m_Walls->labels)
  {
    m_Objects = std::make_unique<LabelMapRun>(static_cast<LabelMap &>(*m_Input).GetObjects(),
                                              planned.input.geometry,
                                              GetParameters(*m_Walls, GetGrid(planned.input)).maximumPoreSize,
                                              *start.survey);
    m_Engines.front().engine->AddObserver(m_Objects->GetObserver());
  }
  for (const auto & product : job.products)
  {
    product->MakeFile(outputs);
    this->AddProduct(*product);
  }
}

void
JobRun::AddProduct(Product & product)
{
  const ProductLinks & links = product.GetLinks();
  if (links.observer != nullptr)
  {
    PieceEngine & engine = *m_Engines.front().engine;
    engine.AddObserver(*links.observer);
    engine.AddRegionListener([&product](const itk::MedialVoxelBox & region) { product.BeginRegion(region); });
  }
  if (m_Objects && links.mesh != nullptr)
  {
    m_Objects->AddMesh(*links.mesh);
  }
  if (links.cells != nullptr)
  {
    m_Objects->KeepCells(*links.cells);
  }
  if (links.volume == nullptr)
  {
    return;
  }
  if (m_Objects)
  {
    m_Objects->AddVolume(*links.request, *links.volume);
    return;
  }
  const auto engine = std::find_if(m_Engines.begin(), m_Engines.end(), [&links](const Engine & known) {
    return known.filler == links.request->filler;
  });
  engine->engine->AddVolume(*links.request, *links.volume);
}

void
JobRun::AddTo(Footprint & footprint, const Job & job)
{
  const auto           walls = job.GetWalls();
  const VolumeHeader & header = job.result.input;
  if (!walls)
  {
    return;
  }
  for (const JobTask & task : job.tasks)
  {
    if (const auto * const thickness = FindWallThickness(task))
    {
      AddWalls(footprint, header, *thickness, FindsWallsBefore(job));
    }
  }
  if (GetSmoothing(*walls) != Smoothing::Off)
  {
    std::uint64_t & sum = InputVolume::IsReadInParallel(header) ? footprint.perThread : footprint.beside;
    sum += InputVolume::GetBytesToSmooth(header);
  }
  if (walls->labels)
  {
    footprint.perVoxelOfUnion = itk::MedialVoxelObjectUnion::BytesPerVoxel;
    footprint.beside += LabelMapRun::GetPlannedMemory(*walls->labels) +
                        itk::MedialVoxelObjectAdjacency::GetBytes(
                          footprint.grid.GetSize(), GetParameters(*walls, footprint.grid).maximumPoreSize);
  }
  // Chunks are read and written in any order; all but labels are made of whole slices.
  const bool readsChunks = header.GetStored().chunks && !header.stored;
  footprint.needsSlices =
    !readsChunks || walls->labels || job.tasks.size() > 1 || job.tasks.front().filler != VolumeFiller::Extraction;
}

/** Balls of the slices of a piece, and of those around it. */
void
JobRun::AddWalls(Footprint &                            footprint,
                 const VolumeHeader &                   header,
                 const itk::MedialVoxelLocalThickness & thickness,
                 const bool                             followsExtraction)
{
  using Balls = itk::MedialVoxelWallBalls;
  for (EngineFootprint & engine : footprint.engines)
  {
    engine.perVoxel += Balls::BytesPerVoxel;
  }
  ProductFootprint    balls;
  const Balls         some(footprint.grid, thickness);
  const std::uint64_t slices = std::min(2 * some.GetMargin(), header.geometry.size.back());
  balls.beside = slices * header.geometry.GetVoxelsPerSlice() * Balls::BytesPerVoxel;
  balls.perVoxelOfTile = followsExtraction ? some.GetBytesPerVoxel() : 0;
  footprint.Add(balls);
}

void
JobRun::Prepare()
{
  m_Job.Measure([this](double) { m_Loop.ThrowIfStopRequested(); });
  if (const std::optional<WallMeasure> & measure = m_Job.result.wallMeasure)
  {
    const auto range = GetGrayRange(*measure, m_Job.options, m_Job.result.input);
    for (const Engine & engine : m_Engines)
    {
      engine.engine->SetGrayRange(range);
    }
    for (const auto & product : m_Job.products)
    {
      product->UseMeasure(*measure);
    }
  }
  if (m_Objects)
  {
    m_Loop.SetRunsPerPiece(m_Objects->GetNumberOfPasses());
    this->ReserveForObjects();
  }
}

void
JobRun::ReserveForObjects()
{
  JobPlan &           plan = m_Job.result.plan;
  const std::uint64_t bytes = LabelMapRun::GetUnplannedMemory(*m_Walls->labels, m_Objects->GetNumberOfObjects());
  if (bytes > plan.memory.limit - std::min(plan.memory.limit, plan.memory.planned))
  {
    Fail(ExitStatus::Refused,
         m_Job.result.input.fileName.string(),
         ": its objects take ",
         FormatBytes(bytes),
         " of memory beside the ",
         FormatBytes(plan.memory.planned),
         " that are planned, ",
         FormatBytes(plan.memory.limit),
         " are allowed; allow more with --memory, or name fewer objects with --labels");
  }
  if (bytes > 0)
  {
    plan.memory.fixed += bytes;
    plan.memory.planned += bytes;
    m_Loop.SetPlan(plan);
    m_Engines.front().engine->SetMemoryLimit(plan.GetEngineLimit(plan.GetSlicesAtOnce()));
  }
}

itk::MedialVoxelSums
JobRun::Run(const SliceRange & range, const SliceRange & nextRange)
{
  PieceEngine &        first = *m_Engines.front().engine;
  itk::MedialVoxelSums sums =
    m_Objects ? m_Objects->Run(m_Loop, first, range, m_Writer) : m_Loop.Run(first, range, nextRange, m_Writer);
  if (m_Engines.front().filler == VolumeFiller::Extraction)
  {
    CheckCounts(sums.counts);
  }
  for (std::size_t i = 1; i < m_Engines.size(); ++i)
  {
    SliceRange own = range;
    SliceRange next = nextRange;
    if (m_Engines[i].filler == VolumeFiller::LocalThickness)
    {
      this->WaitForWalls(own, next);
    }
    if (own.begin == own.end)
    {
      continue;
    }
    itk::MedialVoxelSums others = m_Loop.Run(*m_Engines[i].engine, own, next, m_Writer);
    others.counts = {};                                                         // of the same voxels
    others.distanceSeconds += std::exchange(others.classificationSeconds, 0.0); // no cells are decided
    sums += others;
  }
  return sums;
}

void
JobRun::WaitForWalls(SliceRange & range, SliceRange & nextRange)
{
  const SliceRange whole = range;
  if (whole.begin == m_Extracted.end)
  {
    range.begin = m_Painted.end;
  }
  if (nextRange.begin == whole.end && nextRange.end > whole.end)
  {
    const std::uint64_t unit = m_Job.result.plan.sliceUnit;
    range.end = std::max(range.begin, (whole.end - std::min(whole.end, m_SlicesOfBalls)) / unit * unit);
    nextRange.begin = range.end;
  }
  m_Extracted = whole;
  m_Painted = range;
}

void
JobRun::Release()
{
  for (const Engine & engine : m_Engines)
  {
    engine.engine->Release();
  }
}

void
JobRun::Finish()
{
  m_Writer.Wait();
  m_Engines.clear();
  if (!m_Objects)
  {
    return;
  }
  JobResult & result = m_Job.result;
  result.objects = m_Objects->Summarize();
  for (Json & object : result.objects["objects"])
  {
    if (const Segment * const segment = result.segments.Find(object["label"]))
    {
      object["name"] = segment->name.empty() ? Json(nullptr) : Json(segment->name);
      object["color"] = segment->color ? Json(*segment->color) : Json(nullptr);
    }
  }
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

} // end namespace medialvoxel
