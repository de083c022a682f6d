// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ExtractRun.h"

#include "ExtractParts.h"

namespace medialvoxel
{

VolumeGeometry
FindLabelGeometry(const ExtractOptions & options, const VolumeHeader & header)
{
  const auto input = OpenInputVolume(header, options, {});
  return MakeExtractRunner(*input, header, options, {}, [](double) { return false; })->GetGeometry();
}

ExtractRun::ExtractRun(const ExtractOptions & options, const JobResult & job, ProgressSink & sink)
  : m_Options(options)
  , m_Input(OpenInputVolume(job.input, options, job.plan.scratchFolder))
  , m_Loop(job.plan, job.input, options.distanceFile.empty() ? 1 : 2, sink)
  , m_Runner(MakeExtractRunner(*m_Input, job.input, options, GetCutSettings(job.plan), m_Loop.GetObserver()))
  , m_Survey(job.input.geometry, GetGrid(options, job.input), GetSurveySettings(options))
  , m_Writer(job.plan.writesBehind)
{
  if (job.plan.writesBehind)
  {
    m_Runner->KeepPreviousResults();
  }
  if (!options.distanceFile.empty())
  {
    DistanceSettings settings;
    settings.generateDistance = true;
    settings.cut = GetCutSettings(job.plan);
    m_DistanceRunner = MakeDistanceRunner(*m_Input, job.input, options, settings, m_Loop.GetObserver());
  }
}

void
ExtractRun::AddVolume(const VolumeRequest & request, VoxelOutput & volume)
{
  m_Destinations.push_back({ request.content, request.filler, &volume });
}

void
ExtractRun::AddObserver(itk::MedialVoxelTileObserver & observer)
{
  m_Observers.push_back(&observer);
}

void
ExtractRun::SetSlicesToDo(std::uint64_t slices)
{
  m_Loop.SetSlicesToDo(slices);
}

void
ExtractRun::Prepare()
{
  m_Observers.push_back(&m_Survey);
  m_Runner->SetTileObservers(m_Observers);
  m_Loop.Prepare(*m_Input);
}

void
ExtractRun::Run(const SliceRange & range)
{
  const auto run = [&](PieceRunner & runner, VolumeFiller filler) {
    m_Loop.Run(runner, range, m_Writer, [this, filler](const PieceLoop::Range & piece, const PieceResults & results) {
      this->Write(filler, piece, results);
    });
  };
  run(*m_Runner, VolumeFiller::Extraction);
  if (m_DistanceRunner)
  {
    run(*m_DistanceRunner, VolumeFiller::Distance);
  }
}

void
ExtractRun::Write(VolumeFiller filler, const PieceLoop::Range & range, const PieceResults & results)
{
  if (results.isEmpty && m_Options.sparse)
  {
    return;
  }
  for (const Destination & destination : m_Destinations)
  {
    if (destination.filler == filler)
    {
      destination.volume->Write(range.firstVoxel, range.numberOfVoxels, results[destination.content]);
    }
  }
}

void
ExtractRun::Wait()
{
  m_Writer.Wait();
}

void
ExtractRun::DropFilters()
{
  m_Runner.reset();
  m_DistanceRunner.reset();
}

void
ExtractRun::Release()
{
  m_Runner->Release();
  if (m_DistanceRunner)
  {
    m_DistanceRunner->Release();
  }
}

RunnerSums
ExtractRun::GetSums() const
{
  RunnerSums sums = m_Runner->GetSums();
  if (m_DistanceRunner)
  {
    const RunnerSums distances = m_DistanceRunner->GetSums();
    sums.distanceSeconds += distances.distanceSeconds;
    sums.threadSeconds += distances.threadSeconds;
    sums.tileSeconds += distances.tileSeconds;
    sums.recomputedVoxels += distances.recomputedVoxels;
  }
  return sums;
}

} // end namespace medialvoxel
