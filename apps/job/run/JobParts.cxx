// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobParts.h"

#include "Leftovers.h"
#include "PackedVolume.h"
#include "Text.h"
#include "ZarrVolume.h"

#include "itkMedialVoxelSurfaceObserver.h"
#include "itkMultiThreaderBase.h"
#include "itkProcessObject.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace medialvoxel
{
namespace
{

/** Lets large blocks leave the process when they are freed, so that the peak is the one that was planned. */
void
GiveLargeBlocksBack()
{
#ifdef M_MMAP_THRESHOLD
  constexpr int largeBlock = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, largeBlock);
#endif
}

LogRecord
MakePlanRecord(const JobPlan & plan, const VolumeHeader & header)
{
  return { LogLevel::Info,
           "plan",
           { { "input", header.fileName.string() },
             { "format", header.format },
             { "size", FormatSize(header.geometry.size) },
             { "type", std::string(GetTraits(header.GetStored().pixelType).name) },
             { "pieces", std::to_string(plan.divisions) },
             { "slices_of_piece", std::to_string(plan.GetMaximumSlices()) },
             { "threads", std::to_string(plan.threads) },
             { "planned_memory_bytes", std::to_string(plan.memoryBytes) } } };
}

void
CheckScratchFolder(const JobOptions & options)
{
  std::error_code error;
  if (!options.scratchFolder.empty() && !std::filesystem::is_directory(options.scratchFolder, error))
  {
    Fail(ExitStatus::Refused, options.scratchFolder, ": the scratch folder does not exist");
  }
}

void
CheckFormats(const JobOptions & options, const JobResult & job)
{
  for (const OutputRequest & output : job.outputs)
  {
    if (output.layout)
    {
      CheckVolumeFormat(output.fileName, job.input.geometry, *output.layout, options.compress);
    }
  }
}

void
SetNumberOfThreads(unsigned int threads)
{
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(threads);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
}

} // namespace

std::vector<OutputRequest>
SelectOutputs(const std::vector<OutputRequest> & candidates)
{
  std::vector<OutputRequest> outputs;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(outputs), [](const OutputRequest & candidate) {
    return !candidate.fileName.empty();
  });
  return outputs;
}

JobResult
PrepareJob(const JobOptions &                 options,
           VolumeHeader                       header,
           const std::vector<OutputRequest> & candidates,
           const PieceFootprint &             footprint)
{
  JobResult result;
  result.input = std::move(header);
  result.outputs = SelectOutputs(candidates);
  if (!options.logFile.empty())
  {
    result.outputs.push_back({ "log", options.logFile, std::nullopt, true });
  }
  CheckOutputs(result.outputs, result.input, options.overwrite);
  CheckFormats(options, result);
  CheckScratchFolder(options);
  result.plan = MakePlan(options, result.input, result.outputs, footprint);
  if (!options.dryRun)
  {
    RemoveLeftovers(result.outputs); // before space is taken for the new ones
  }
  PrepareProcess(result.plan);
  return result;
}

void
PrepareProcess(const JobPlan & plan)
{
  SetNumberOfThreads(plan.threads);
  GiveLargeBlocksBack();
}

itk::MedialVoxelGrid
GetGrid(const JobOptions & options, const VolumeHeader & header)
{
  itk::MedialVoxelIndex             size{ { 1, 1, 1 } };
  itk::MedialVoxelGrid::SpacingType spacing{ { 1.0, 1.0, 1.0 } };
  for (unsigned int axis = 0; axis < header.geometry.GetDimension(); ++axis)
  {
    size[axis] = static_cast<std::int64_t>(header.geometry.size[axis]);
    spacing[axis] = options.voxelUnits ? 1.0 : header.geometry.spacing[axis];
  }
  return { size, spacing };
}

void
AddEngine(PieceFootprint & footprint, const VolumeHeader & header, const itk::MedialVoxelEngineTask & task)
{
  const bool isReal = header.pixelType == PixelType::Float32 || header.pixelType == PixelType::Float64;
  itk::MedialVoxelEngineSettings settings;
  settings.task = task;
  settings.countsNotANumber = isReal && header.CanStream();
  footprint.engines.push_back(std::move(settings));
}

/** All volumes of a job have as many slices, and so have their layers. */
std::uint64_t
GetSlicesOfLayer(const VolumeHeader & header, const std::vector<OutputRequest> & candidates)
{
  const auto output = std::find_if(candidates.begin(), candidates.end(), IsZarrOutput);
  return output == candidates.end() ? 1 : ZarrGrid::ForVolume(header.geometry, *output->layout).chunk[2];
}

void
AddOutputs(PieceFootprint &                   footprint,
           const JobOptions &                 options,
           const VolumeHeader &               header,
           const std::vector<OutputRequest> & candidates)
{
  for (const OutputRequest & output : candidates)
  {
    if (IsZarrOutput(output))
    {
      footprint.bytesBeside += ZarrVolume::GetMemoryBytes(header.geometry, *output.layout, options.zarrCompression);
    }
  }
  footprint.bytesBeside +=
    PackedVolume::GetMemoryBytes() *
    static_cast<std::uint64_t>(
      std::count_if(candidates.begin(), candidates.end(), [&options](const OutputRequest & output) {
        return output.layout && !output.fileName.empty() && IsPackedVolume(output.fileName, options.compress);
      }));
  footprint.preferredSlices = GetSlicesOfLayer(header, candidates);
}

CutSettings
GetCutSettings(const JobPlan & plan)
{
  return { plan.slabThickness, plan.GetFilterLimit(plan.GetMaximumSlices()) };
}

VoxelLayout
GetVectorLayout(const VolumeHeader & header)
{
  return { PixelType::Float32, header.geometry.GetDimension() };
}

std::string
FormatSlices(const SliceRange & slices)
{
  return std::to_string(slices.begin) + "-" + std::to_string(slices.end - 1);
}

PieceLoop::PieceLoop(const JobPlan &      plan,
                     const VolumeHeader & header,
                     unsigned int         runnersPerPiece,
                     ProgressSink &       sink)
  : m_Plan(plan)
  , m_SlicesAtOnce(plan.GetMaximumSlices())
  , m_SlicesToDo(plan.numberOfSlices)
  , m_VoxelsPerSlice(header.geometry.GetVoxelsPerSlice())
  , m_RunnersPerPiece(runnersPerPiece)
  , m_Sink(sink)
{
  m_Sink.Record(MakePlanRecord(plan, header));
}

PieceObserver
PieceLoop::GetObserver()
{
  return [this](double fraction) {
    const double slices = static_cast<double>(m_DoneSlices) + fraction * static_cast<double>(m_SlicesOfPiece);
    const double done = slices / static_cast<double>(m_SlicesToDo * m_RunnersPerPiece);
    m_Sink.Report(m_ShareOfPreparation + (1.0 - m_ShareOfPreparation) * done);
    return m_Sink.IsStopRequested();
  };
}

void
PieceLoop::Prepare(InputVolume & input)
{
  m_Input = &input;
  constexpr double  share = 0.3;
  const std::string note = input.Prepare([this](double fraction) {
    m_ShareOfPreparation = share;
    m_Sink.Report(share * fraction);
    this->ThrowIfStopRequested();
  });
  if (!note.empty())
  {
    m_Sink.Note(note);
  }
}

void
PieceLoop::Run(PieceRunner & runner, const SliceRange & piece, WriteBehind & writer, const WriteFunction & write)
{
  for (SliceRange slices{ piece.begin, 0 }; slices.begin < piece.end;)
  {
    slices.end = std::min(slices.begin + m_SlicesAtOnce, piece.end);
    try
    {
      this->RunSlices(runner, slices, writer, write);
      slices.begin = slices.end;
    }
    catch (const itk::MedialVoxelMemoryError & error)
    {
      this->ShortenPieces(runner, "memory of windows");
      const std::uint64_t limit = m_Plan.GetFilterLimit(m_SlicesAtOnce);
      if (limit <= error.GetAllowedBytes())
      {
        throw;
      }
      writer.Wait();
      runner.Release();
      runner.SetMemoryLimit(limit);
    }
    catch (const itk::MedialVoxelSurfacePieceError &)
    {
      this->ShortenPieces(runner, "memory of the surface");
    }
  }
}

void
PieceLoop::ShortenPieces(const PieceRunner & runner, const char * reason)
{
  m_SlicesAtOnce = std::max<std::uint64_t>(1, m_SlicesAtOnce / 2);
  m_Sink.Record(
    { LogLevel::Warning,
      "shorten",
      { { "of", runner.GetName() }, { "slices_at_once", std::to_string(m_SlicesAtOnce) }, { "reason", reason } } });
}

void
PieceLoop::RunSlices(PieceRunner & runner, const SliceRange & slices, WriteBehind & writer, const WriteFunction & write)
{
  this->ThrowIfStopRequested();
  m_SlicesOfPiece = slices.end - slices.begin;
  const auto          start = JobClock::now();
  const std::uint64_t recomputed = runner.GetSums().recomputedVoxels;
  PieceResults        results;
  try
  {
    results = runner.Run(slices.begin, m_SlicesOfPiece);
  }
  catch (const itk::ProcessAborted &)
  {
    throw StoppedBySignal(GetStopSignal());
  }
  this->RecordPiece(runner, slices, SecondsSince(start), runner.GetSums().recomputedVoxels - recomputed);
  const auto  computed = JobClock::now();
  const Range range{ slices, slices.begin * m_VoxelsPerSlice, m_SlicesOfPiece * m_VoxelsPerSlice };
  writer.Submit([write, range, results] { write(range, results); });
  m_Sink.Record({ LogLevel::Debug,
                  "write",
                  { { "of", runner.GetName() },
                    { "slices", FormatSlices(slices) },
                    { "seconds_waited", FormatFixed(SecondsSince(computed), 3) } } });
  // A single runner uses the memory of its results again, which is much cheaper than new memory for each piece.
  if (m_RunnersPerPiece > 1)
  {
    writer.Wait();
    runner.Release();
  }
  m_DoneSlices += m_SlicesOfPiece;
}

void
PieceLoop::RecordPiece(const PieceRunner & runner,
                       const SliceRange &  slices,
                       double              seconds,
                       std::uint64_t       recomputedVoxels)
{
  m_Sink.Record({ LogLevel::Info,
                  "piece",
                  { { "of", runner.GetName() },
                    { "slices", FormatSlices(slices) },
                    { "seconds", FormatFixed(seconds, 3) },
                    { "recomputed_voxels", std::to_string(recomputedVoxels) },
                    { "bytes_read", std::to_string(m_Input->GetNumberOfBytesRead()) },
                    { "peak_memory_bytes", std::to_string(GetPeakMemoryBytes()) } } });
}

void
PieceLoop::ThrowIfStopRequested() const
{
  if (m_Sink.IsStopRequested())
  {
    throw StoppedBySignal(GetStopSignal());
  }
}

std::uint64_t
GetPeakMemoryBytes()
{
  std::ifstream status("/proc/self/status");
  std::string   line;
  while (std::getline(status, line))
  {
    const std::vector<std::string> parts = SplitAtBlanks(line);
    if (parts.size() >= 2 && parts[0] == "VmHWM:")
    {
      return static_cast<std::uint64_t>(ParseInteger(parts[1]).value_or(0)) * 1024;
    }
  }
  return 0;
}

void
AddMeasurements(JobResult & result, const InputVolume & input, double writeSeconds, JobClock::time_point start)
{
  result.seconds.distance = result.sums.distanceSeconds;
  result.seconds.classification = result.sums.classificationSeconds;
  result.seconds.tiles = result.sums.tileSeconds;
  result.seconds.inputOutput = input.GetReadSeconds() + writeSeconds;
  result.seconds.total = SecondsSince(start);
  result.bytesRead = input.GetNumberOfBytesRead();
  result.peakMemoryBytes = GetPeakMemoryBytes();
}

} // end namespace medialvoxel
