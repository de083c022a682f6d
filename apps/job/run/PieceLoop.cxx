// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceLoop.h"

#include "Errors.h"
#include "JobClock.h"
#include "PeakMemory.h"
#include "Signals.h"
#include "Text.h"
#include "VolumeFormats.h"

#include "itkMedialVoxelMemoryError.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSurfaceObserver.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

LogRecord
MakePlanRecord(const JobPlan & plan, const VolumeHeader & header)
{
  return { LogLevel::Info,
           "plan",
           { { "input", header.fileName.string() },
             { "format", header.format->name },
             { "size", FormatSize(header.geometry.size) },
             { "type", std::string(GetTraits(header.GetStored().pixelType).name) },
             { "pieces", std::to_string(plan.divisions) },
             { "slices_of_piece", std::to_string(plan.GetMaximumSlices()) },
             { "threads", std::to_string(plan.threads) },
             { "planned_memory_bytes", std::to_string(plan.memoryBytes) } } };
}

} // namespace

PieceLoop::PieceLoop(const JobPlan &      plan,
                     const VolumeHeader & header,
                     unsigned int         enginesPerPiece,
                     ProgressSink &       sink)
  : m_Plan(plan)
  , m_SlicesAtOnce(plan.GetMaximumSlices())
  , m_SlicesToDo(plan.numberOfSlices)
  , m_VoxelsPerSlice(header.geometry.GetVoxelsPerSlice())
  , m_EnginesPerPiece(enginesPerPiece)
  , m_Sink(sink)
{
  m_Sink.Record(MakePlanRecord(plan, header));
}

PieceObserver
PieceLoop::GetObserver()
{
  return [this](double fraction) {
    m_FractionOfPiece = fraction;
    const double slices = static_cast<double>(m_DoneSlices) + fraction * static_cast<double>(m_SlicesOfPiece);
    const double done = slices / static_cast<double>(m_SlicesToDo * m_EnginesPerPiece * m_RunsPerPiece);
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

itk::MedialVoxelSums
PieceLoop::Run(PieceEngine & engine, const SliceRange & piece, const SliceRange & nextPiece, WriteBehind & writer)
{
  itk::MedialVoxelSums sums;
  for (SliceRange slices{ piece.begin, 0 }; slices.begin < piece.end;)
  {
    slices.end = std::min(slices.begin + m_SlicesAtOnce, piece.end);
    try
    {
      SliceRange next{ slices.end, std::min(slices.end + m_SlicesAtOnce, piece.end) };
      if (next.begin == next.end)
      {
        next = { nextPiece.begin, std::min(nextPiece.begin + m_SlicesAtOnce, nextPiece.end) };
      }
      sums += this->RunSlices(engine, slices, next, writer);
      slices.begin = slices.end;
    }
    catch (const itk::MedialVoxelMemoryError & error)
    {
      this->ShortenPieces(engine, 0.5, "memory of windows");
      const std::uint64_t limit = m_Plan.GetEngineLimit(m_SlicesAtOnce);
      if (limit <= error.GetAllowedBytes())
      {
        throw;
      }
      writer.Wait();
      engine.Release();
      engine.SetMemoryLimit(limit);
    }
    catch (const itk::MedialVoxelSurfacePieceError &)
    {
      // What fitted, with room for parts that have more of it.
      this->ShortenPieces(engine, std::clamp(0.7 * m_FractionOfPiece, 0.125, 0.5), "memory of the surface");
    }
  }
  return sums;
}

void
PieceLoop::ShortenPieces(const PieceEngine & engine, const double share, const char * reason)
{
  const double slices = share * static_cast<double>(m_SlicesAtOnce);
  m_SlicesAtOnce = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(slices));
  m_Sink.Record(
    { LogLevel::Warning,
      "shorten",
      { { "of", engine.GetName() }, { "slices_at_once", std::to_string(m_SlicesAtOnce) }, { "reason", reason } } });
}

itk::MedialVoxelSums
PieceLoop::RunSlices(PieceEngine &      engine,
                     const SliceRange & slices,
                     const SliceRange & nextSlices,
                     WriteBehind &      writer)
{
  this->ThrowIfStopRequested();
  m_SlicesOfPiece = slices.end - slices.begin;
  m_FractionOfPiece = 0.0;
  const auto   start = JobClock::now();
  PieceResults results;
  try
  {
    results = engine.Run(slices, nextSlices);
  }
  catch (const itk::MedialVoxelAborted &)
  {
    throw StoppedBySignal(GetStopSignal());
  }
  this->RecordPiece(engine, slices, SecondsSince(start), results.sums.recomputedVoxels);
  const auto computed = JobClock::now();
  writer.Submit([parts = results.parts,
                 firstVoxel = slices.begin * m_VoxelsPerSlice,
                 numberOfVoxels = m_SlicesOfPiece * m_VoxelsPerSlice] {
    for (const PieceResults::Part & part : parts)
    {
      part.volume->Write(firstVoxel, numberOfVoxels, part.voxels);
    }
  });
  m_Sink.Record({ LogLevel::Debug,
                  "write",
                  { { "of", engine.GetName() },
                    { "slices", FormatSlices(slices) },
                    { "seconds_waited", FormatFixed(SecondsSince(computed), 3) } } });
  // A single engine uses the memory of its results again, which is much cheaper than new memory for each piece.
  if (m_EnginesPerPiece > 1)
  {
    writer.Wait();
    engine.Release();
  }
  m_DoneSlices += m_SlicesOfPiece;
  return results.sums;
}

void
PieceLoop::RecordPiece(const PieceEngine & engine,
                       const SliceRange &  slices,
                       double              seconds,
                       std::uint64_t       recomputedVoxels)
{
  m_Sink.Record({ LogLevel::Info,
                  "piece",
                  { { "of", engine.GetName() },
                    { "slices", FormatSlices(slices) },
                    { "seconds", FormatFixed(seconds, 3) },
                    { "recomputed_voxels", std::to_string(recomputedVoxels) },
                    { "bytes_read", std::to_string(m_Input->GetNumberOfBytesRead()) },
                    { "peak_memory_bytes", std::to_string(GetPeakMemoryBytes()) } } });
}

void
PieceLoop::ThrowIfStopRequested() const
{
  medialvoxel::ThrowIfStopRequested(m_Sink);
}

} // end namespace medialvoxel
