// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ExtractRun.h"

#include "ExtractParts.h"

#include <algorithm>
#include <iterator>

namespace medialvoxel
{

VolumeGeometry
FindLabelGeometry(const ExtractOptions & options, const VolumeHeader & header)
{
  const auto input = OpenInputVolume(header, options, {});
  return MakeExtractRunner(*input, header, options, {}, [](double) { return false; })->GetGeometry();
}

std::vector<VolumeRequest>
ListVolumes(const ExtractOptions & options, const VolumeHeader & header, const VolumeGeometry & labels)
{
  const std::vector<VolumeRequest> candidates{
    { "labels", options.output, labels, LabelLayout },
    { "vectors", options.vectorFile, header.geometry, GetVectorLayout(header) },
    { "distance", options.distanceFile, header.geometry, DistanceLayout },
    { "thickness_map", options.thicknessFile, labels, ThicknessLayout }
  };
  std::vector<VolumeRequest> wanted;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(wanted), [](const VolumeRequest & candidate) {
    return !candidate.fileName.empty();
  });
  return wanted;
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
ExtractRun::SetVolume(const std::string & role, VoxelOutput * volume)
{
  (role == "labels"     ? m_Labels
   : role == "vectors"  ? m_Vectors
   : role == "distance" ? m_Distances
                        : m_Thicknesses) = volume;
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
  m_Loop.Run(*m_Runner, range, m_Writer, [this](const PieceLoop::Range & piece, const PieceResults & results) {
    this->Write(piece, results);
  });
  if (m_DistanceRunner)
  {
    m_Loop.Run(
      *m_DistanceRunner, range, m_Writer, [this](const PieceLoop::Range & piece, const PieceResults & results) {
        m_Distances->Write(piece.firstVoxel, piece.numberOfVoxels, results.distances);
      });
  }
}

void
ExtractRun::Write(const PieceLoop::Range & range, const PieceResults & results)
{
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
