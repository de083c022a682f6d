// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceLoop.h"

#include "Errors.h"
#include "JobClock.h"
#include "ProcessMemory.h"
#include "PlaceSurvey.h"
#include "Signals.h"
#include "Text.h"
#include "VolumeFormats.h"

#include "itkMedialVoxelMemoryShortage.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSurfaceObserver.h"

#include <algorithm>
#include <string>

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
             { "planned_memory_bytes", std::to_string(plan.memory.planned) } } };
}

[[noreturn]] void
RefusePlaces(std::uint64_t slice, std::uint64_t allowedBytes)
{
  throw PieceMemoryError("slice " + std::to_string(slice) + " needs more than the " + FormatBytes(allowedBytes) +
                         " of memory that are left for its thin or thick places; allow more with --memory, or look for "
                         "fewer: a smaller --thin-below, a larger --thick-above");
}

void
WriteSpan(const PieceResults::Part & part, const PieceRange & range, std::uint64_t voxelsPerSlice)
{
  const SliceRange & slices = range.slices;
  if (range.rows)
  {
    part.volume->WriteRows(slices, *range.rows, part.voxels);
    return;
  }
  part.volume->Write(slices.begin * voxelsPerSlice, (slices.end - slices.begin) * voxelsPerSlice, part.voxels);
}

} // namespace

PieceLoop::PieceLoop(const JobPlan &      plan,
                     const VolumeHeader & header,
                     unsigned int         enginesPerPiece,
                     ProgressSink &       sink)
  : m_Plan(plan)
  , m_SlicesAtOnce(plan.GetSlicesAtOnce())
  , m_SlicesToDo(plan.numberOfSlices)
  , m_VoxelsPerSlice(header.geometry.GetVoxelsPerSlice())
  , m_RowsPerSlice(header.geometry.GetDimension() == 3 ? header.geometry.size[1] : 1)
  , m_EnginesPerPiece(enginesPerPiece)
  , m_Sink(sink)
{
  m_Sink.Record(MakePlanRecord(plan, header));
}

PieceObserver
PieceLoop::GetObserver()
{
  return [this](double fraction) {
    m_FractionOfRange = fraction;
    const double voxels = static_cast<double>(m_DoneVoxels) + fraction * static_cast<double>(m_VoxelsOfRange);
    const double all = static_cast<double>(m_SlicesToDo * m_EnginesPerPiece * m_RunsPerPiece);
    const double done = voxels / (all * static_cast<double>(m_VoxelsPerSlice));
    m_Sink.Report(m_ShareOfPreparation + (1.0 - m_ShareOfPreparation - m_ShareOfEnd) * done);
    return m_Sink.IsStopRequested();
  };
}

itk::MedialVoxelSums
PieceLoop::Run(PieceEngine & engine, const SliceRange & piece, const SliceRange & nextPiece, WriteBehind & writer)
{
  if (m_Plan.rowsAtOnce == 0)
  {
    return this->RunSlices(engine, { piece }, { nextPiece }, writer);
  }
  itk::MedialVoxelSums sums;
  for (SliceRange slices{ piece.begin, 0 }; slices.begin < piece.end; slices.begin = slices.end)
  {
    // Whole layers of chunks, wherever the piece begins.
    slices.end = std::min((slices.begin / m_Plan.slicesAtOnce + 1) * m_Plan.slicesAtOnce, piece.end);
    for (RowRange rows = this->GetRowsFrom(0); rows.begin < m_RowsPerSlice; rows = this->GetRowsFrom(rows.end))
    {
      const RowRange next = this->GetRowsFrom(rows.end);
      sums += this->RunSlices(
        engine, { slices, rows }, { next.begin < m_RowsPerSlice ? slices : SliceRange{}, next }, writer);
    }
  }
  return sums;
}

RowRange
PieceLoop::GetRowsFrom(std::uint64_t begin) const
{
  return { begin, std::min(begin + m_Plan.rowsAtOnce, m_RowsPerSlice) };
}

/** In smaller ranges when the walls need more memory than results of this size leave. */
itk::MedialVoxelSums
PieceLoop::RunSlices(PieceEngine & engine, const PieceRange & range, const PieceRange & nextRange, WriteBehind & writer)
{
  itk::MedialVoxelSums sums;
  const auto           limit = [this](PieceRange some) {
    some.slices.end = std::min(some.slices.begin + m_SlicesAtOnce, some.slices.end);
    return some;
  };
  for (PieceRange rest = range; rest.slices.begin < range.slices.end;)
  {
    const PieceRange now = limit(rest);
    const PieceRange then = limit({ { now.slices.end, range.slices.end }, range.rows });
    try
    {
      sums += this->RunRange(engine, now, now.slices.end < range.slices.end ? then : limit(nextRange), writer);
      rest.slices.begin = now.slices.end;
    }
    catch (const itk::MedialVoxelMemoryShortage & error)
    {
      this->ShortenPieces(engine, 0.5, "memory of windows");
      const std::uint64_t bytes = m_Plan.GetEngineLimit(m_SlicesAtOnce);
      if (bytes <= error.GetAllowedBytes())
      {
        throw;
      }
      writer.Wait();
      engine.Release();
      engine.SetMemoryLimit(bytes);
    }
    catch (const itk::MedialVoxelSurfacePieceError &)
    {
      // The last size that fitted, with room for parts that have more.
      this->ShortenPieces(engine, std::clamp(0.7 * m_FractionOfRange, 0.125, 0.5), "memory of the surface");
    }
    catch (const PlaceMemoryError & error)
    {
      if (now.slices.end - now.slices.begin == 1)
      {
        RefusePlaces(now.slices.begin, error.GetAllowedBytes());
      }
      this->ShortenPieces(engine, std::clamp(0.7 * m_FractionOfRange, 0.125, 0.5), "memory of thin or thick places");
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
PieceLoop::RunRange(PieceEngine & engine, const PieceRange & range, const PieceRange & nextRange, WriteBehind & writer)
{
  this->ThrowIfStopRequested();
  m_VoxelsOfRange = this->CountVoxels(range);
  m_FractionOfRange = 0.0;
  const auto   start = JobClock::now();
  PieceResults results;
  try
  {
    results = engine.Run(range, nextRange);
  }
  catch (const itk::MedialVoxelAborted &)
  {
    throw StoppedBySignal(GetStopSignal());
  }
  this->RecordPiece(engine, range, SecondsSince(start), results.sums.recomputedVoxels);
  writer.Submit([range, parts = results.parts, voxelsPerSlice = m_VoxelsPerSlice] {
    for (const PieceResults::Part & part : parts)
    {
      WriteSpan(part, range, voxelsPerSlice);
    }
  });
  // A single engine uses the memory of its results again, which is much cheaper than new memory for each piece.
  if (m_EnginesPerPiece > 1)
  {
    writer.Wait();
    engine.Release();
  }
  m_DoneVoxels += m_VoxelsOfRange;
  return results.sums;
}

std::uint64_t
PieceLoop::CountVoxels(const PieceRange & range) const
{
  const std::uint64_t perRow = m_VoxelsPerSlice / m_RowsPerSlice;
  const std::uint64_t perSlice = range.rows ? (range.rows->end - range.rows->begin) * perRow : m_VoxelsPerSlice;
  return (range.slices.end - range.slices.begin) * perSlice;
}

void
PieceLoop::RecordPiece(const PieceEngine & engine,
                       const PieceRange &  range,
                       double              seconds,
                       std::uint64_t       recomputedVoxels)
{
  m_Sink.Record({ LogLevel::Info,
                  "piece",
                  { { "of", engine.GetName() },
                    { "slices", FormatSlices(range.slices) },
                    { "seconds", FormatFixed(seconds, 3) },
                    { "recomputed_voxels", std::to_string(recomputedVoxels) },
                    { "bytes_read", std::to_string(m_Input->GetSource().GetNumberOfBytesRead()) },
                    { "peak_memory_bytes", std::to_string(GetPeakMemory()) } } });
}

void
PieceLoop::ThrowIfStopRequested() const
{
  medialvoxel::ThrowIfStopRequested(m_Sink);
}

} // end namespace medialvoxel
