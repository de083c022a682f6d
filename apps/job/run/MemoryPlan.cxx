// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "InputVolume.h"
#include "ProcessMemory.h"
#include "Text.h"
#include "VolumeFormats.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

// Measured on whole runs: the process without work, and a thread beyond the plan of its engine.
constexpr std::uint64_t ProgramMemory = 15 * MiB;
constexpr std::uint64_t ThreadMemory = 1 * MiB;

/** Beside the values and the needs of the format of the volume. */
constexpr std::uint64_t UnpackingMemory = 3 * MiB;

/** An engine pulls input in whole slices of at least this many bytes. */
constexpr std::uint64_t LeastPull = 1 * MiB;

/** Results of a piece when nothing else limits them, of all threads and of each; larger ones gain nothing. */
constexpr std::uint64_t LargestResults = 32 * MiB;
constexpr std::uint64_t LargestResultsPerThread = 2 * MiB;

/** Results of a slab above which half a slab saves more memory than its repeated halo costs time. */
constexpr std::uint64_t LargeSlab = 128 * MiB;

/** The same for slices that are done in rows, whose neighbors are read again for each piece. */
constexpr std::uint64_t LargestRows = 256 * MiB;

/** The largest piece for which writing it in the background is worth a second one in memory. */
constexpr std::uint64_t LargestWrittenBehind = 256 * MiB;

/** Buffers of three volumes that are written past the page cache. */
constexpr std::uint64_t WritingMemory = 6 * MiB;

/** The constants of the search for a fitting plan. */
struct Request
{
  const JobOptions &   options;
  const VolumeHeader & header;
  const Footprint &    footprint;
};

/** The slices of the file around the slices of a pull. */
std::uint64_t
EstimateResampling(const VolumeHeader & header)
{
  const VolumeHeader & stored = *header.stored;
  const std::uint64_t  perSlice = stored.geometry.GetVoxelsPerSlice() * GetTraits(stored.GetValueType()).bytes;
  return LeastPull + 3 * perSlice;
}

/** Readers of chunks. Resampling has one and asks for a few slices at a time, so that a layer of chunks stays. */
std::uint64_t
EstimateChunks(const JobPlan & plan, const VolumeHeader & header)
{
  const VolumeChunks & chunks = *header.GetStored().chunks;
  return chunks.bytesOfIndices +
         (header.stored ? chunks.bytesPerThread + chunks.bytesPerLayer : plan.threads * chunks.bytesPerThread);
}

/** Memory that depends neither on pieces nor on slabs. */
std::uint64_t
EstimateFixedMemory(const JobPlan & plan, const Request & request)
{
  const VolumeHeader & header = request.header;
  const std::uint64_t  bytesPerVoxel = GetTraits(header.GetValueType()).bytes;
  const std::uint64_t  voxels = header.geometry.GetNumberOfVoxels();
  const std::uint64_t  pull = InputVolume::IsReadInParallel(header)
                                ? plan.threads * InputVolume::SpanSize
                                : std::max(LeastPull, header.geometry.GetVoxelsPerSlice() * bytesPerVoxel);
  const std::uint64_t  reading =
    header.GetStored().chunks ? EstimateChunks(plan, header) : std::min(pull, voxels * bytesPerVoxel);
  const VolumeInput & input = header.format->input;
  const std::uint64_t decoding = input.getMemory ? input.getMemory(header.GetStored(), plan.threads) : 0;
  const std::uint64_t unpacking = header.decoderMemory + (header.compressed ? UnpackingMemory : 0);
  const std::uint64_t resampling = header.stored ? EstimateResampling(header) : 0;
  const std::uint64_t unpacked = plan.scratchFolder.empty() ? plan.memory.unpacked : 0;
  const std::uint64_t writing = plan.writesBehind ? WritingMemory : 0;
  const std::uint64_t perThread = ThreadMemory + request.footprint.perThread;
  return ProgramMemory + perThread * plan.threads + writing + reading + decoding + unpacked + unpacking + resampling +
         request.footprint.beside;
}

std::unique_ptr<const itk::MedialVoxelEngine>
MakeEngine(const JobPlan & plan, const Request & request, itk::MedialVoxelEngineSettings settings)
{
  settings.numberOfWorkers = plan.threads;
  settings.slabThickness = static_cast<std::int64_t>(plan.slabThickness);
  settings.readsAhead = plan.readsAhead;
  return std::make_unique<const itk::MedialVoxelEngine>(request.footprint.grid, settings);
}

/** As much as an engine does at once has no more rows than this. */
itk::MedialVoxelBox
GetLargestBox(const JobPlan & plan, const Request & request)
{
  itk::MedialVoxelBox box = request.footprint.grid.GetVoxelBox();
  if (plan.rowsAtOnce > 0)
  {
    box.upper[1] = std::min(box.upper[1], static_cast<std::int64_t>(plan.rowsAtOnce));
  }
  return box;
}

/** Windows and threads of all engines, for walls of up to PlannedWallThickness. Each has the same share of the memory.
 */
std::uint64_t
EstimateEngines(const JobPlan & plan, const Request & request)
{
  std::uint64_t most = 0;
  for (const EngineFootprint & engine : request.footprint.engines)
  {
    most = std::max(most, MakeEngine(plan, request, engine.settings)->GetBytes(GetLargestBox(plan, request)));
  }
  return most * request.footprint.engines.size();
}

/** Slices of a slab that the engine chooses when memory does not matter. */
std::uint64_t
GetSlabThicknessOfEngine(const JobPlan & plan, const Request & request)
{
  const auto engine = MakeEngine(plan, request, request.footprint.engines.front().settings);
  const auto thickness = static_cast<std::uint64_t>(engine->GetSlabThickness(GetLargestBox(plan, request)));
  return std::min(thickness, plan.numberOfSlices);
}

/** Slices of a slab when there is no limit: half of the engine's choice where results are large. */
std::uint64_t
GetPreferredSlabThickness(const JobPlan & plan, std::uint64_t slabOfEngine)
{
  const bool isLarge = slabOfEngine > 1 && slabOfEngine * plan.memory.perSlice > LargeSlab;
  return isLarge ? slabOfEngine / 2 : slabOfEngine;
}

/** Divides the slices for the threads, slabs and scratch folder of the plan; true when that fits.
 * \param slab slices that a piece should have at least */
bool
TryDivisions(JobPlan & plan, const Request & request, std::uint64_t slab)
{
  plan.memory.fixed = EstimateFixedMemory(plan, request);
  const std::uint64_t least = plan.memory.fixed + EstimateEngines(plan, request);
  const std::uint64_t rest = plan.memory.limit - std::min(plan.memory.limit, least);
  const std::uint64_t ofAll = std::max(LargestResults, plan.threads * LargestResultsPerThread);
  const std::uint64_t largest = plan.rowsAtOnce > 0 ? LargestRows : ofAll;
  // Most of the rest is for the engines, should walls be thicker than planned.
  const std::uint64_t bytes = std::min(rest / (plan.writesBehind ? 16 : 8), largest);
  const std::uint64_t slices = std::max(slab, bytes / plan.memory.perSlice);
  const std::uint64_t unit = slices < request.footprint.slicesOfLayer ? 1 : request.footprint.slicesOfLayer;
  plan.slicesAtOnce = plan.rowsAtOnce > 0 ? slices / unit * unit : 0;
  if (request.options.divisions)
  {
    plan.divisions = std::min(*request.options.divisions, plan.numberOfSlices);
  }
  else
  {
    plan.sliceUnit = unit;
    const std::uint64_t unitsPerPiece = std::min(slices / plan.sliceUnit, plan.GetNumberOfUnits());
    plan.divisions = (plan.GetNumberOfUnits() - 1) / unitsPerPiece + 1;
  }
  plan.memory.planned =
    std::max(least + plan.GetResults(plan.GetSlicesAtOnce()), plan.memory.fixed + request.footprint.ofEnd);
  return plan.memory.planned <= plan.memory.limit;
}

/** True for pieces of moderate size, of which another one follows. */
bool
GainsFromWritingBehind(const JobPlan & plan)
{
  const std::uint64_t slices = plan.GetSlicesAtOnce();
  return slices < plan.numberOfSlices && slices * plan.memory.perSlice <= LargestWrittenBehind;
}

/** Divides with slabs of so many slices, with a second window if it fits. */
bool
TrySlab(JobPlan & plan, const Request & request, bool writesBehind, std::uint64_t slab)
{
  for (const bool readsAhead : { true, false })
  {
    plan.readsAhead = readsAhead;
    plan.writesBehind = writesBehind;
    if (TryDivisions(plan, request, slab))
    {
      plan.writesBehind = writesBehind && GainsFromWritingBehind(plan);
      return plan.writesBehind == writesBehind || TryDivisions(plan, request, slab);
    }
  }
  return false;
}

/** Rows of the slices that the engines do at once; 0: all of them. */
void
SetRowsAtOnce(JobPlan & plan, const Request & request, std::uint64_t rows)
{
  const VolumeGeometry & geometry = request.header.geometry;
  plan.rowsAtOnce = rows;
  plan.memory.perSlice =
    (rows > 0 ? geometry.size[0] * rows : geometry.GetVoxelsPerSlice()) * request.footprint.GetResults();
}

/** Thinner slabs read and do more twice, so that the thickest that fit are taken; waiting for the disk costs more than
 * slabs of a quarter.
 * \param takesThin false: none that are thinner than this */
bool
TrySlabs(JobPlan & plan, const Request & request, bool takesThin)
{
  plan.slabThickness = 0;
  const std::uint64_t slabOfEngine = GetSlabThicknessOfEngine(plan, request);
  const std::uint64_t preferred = GetPreferredSlabThickness(plan, slabOfEngine);
  for (const bool writesBehind : { true, false })
  {
    if (writesBehind && plan.numberOfEngines > 1)
    {
      continue;
    }
    const std::uint64_t thinnest = writesBehind || !takesThin ? std::max(slabOfEngine / 4, std::uint64_t{ 1 }) : 1;
    for (std::uint64_t slab = preferred; slab >= thinnest; slab /= 2)
    {
      plan.slabThickness = slab == slabOfEngine ? 0 : slab;
      plan.slabSlices = slab;
      if (TrySlab(plan, request, writesBehind, slab))
      {
        return true;
      }
    }
  }
  return false;
}

/** Slabs that are much thinner than the halo around them cost more than halos of rows. */
bool
TryRows(JobPlan & plan, const Request & request)
{
  SetRowsAtOnce(plan, request, 0);
  const std::uint64_t rows = request.footprint.GetRows();
  if (rows == 0)
  {
    return TrySlabs(plan, request, true);
  }
  if (TrySlabs(plan, request, false))
  {
    return true;
  }
  SetRowsAtOnce(plan, request, rows);
  return TrySlabs(plan, request, true);
}

/** Values of compressed input are in memory when that fits, otherwise in the scratch folder if there is one. */
bool
TryScratch(JobPlan & plan, const Request & request)
{
  plan.scratchFolder.clear();
  if (TryRows(plan, request))
  {
    return true;
  }
  if (!request.header.compressed || request.options.scratchFolder.empty())
  {
    return false;
  }
  plan.scratchFolder = request.options.scratchFolder;
  return TryRows(plan, request);
}

/** As many threads as half of the memory holds, fewer than the plan has; the rest is for thicker walls. */
bool
TryFewerThreads(JobPlan & plan, const Request & request)
{
  const std::uint64_t all = std::exchange(plan.memory.limit, plan.memory.limit / 2);
  unsigned int        fitting = 0;
  for (unsigned int tooMany = plan.threads; tooMany - fitting > 1;)
  {
    plan.threads = fitting + (tooMany - fitting) / 2;
    (TryScratch(plan, request) ? fitting : tooMany) = plan.threads;
  }
  plan.memory.limit = all;
  plan.threads = std::max(fitting, 1u);
  return TryScratch(plan, request);
}

/** A part of the memory that is left is for chunks that reach beyond a slab, or they are unpacked for each slab. */
void
AddChunksToKeep(JobPlan & plan, const Request & request)
{
  const VolumeHeader & header = request.header;
  if (!header.GetStored().chunks)
  {
    return;
  }
  constexpr std::uint64_t shareOfRest = 4;
  const std::uint64_t     layer = header.GetStored().chunks->bytesPerLayer;
  plan.memory.toKeep = header.stored ? layer : std::min((plan.memory.limit - plan.memory.planned) / shareOfRest, layer);
  if (!header.stored)
  {
    plan.memory.fixed += plan.memory.toKeep;
    plan.memory.planned += plan.memory.toKeep;
  }
}

/** The share of the remaining memory for results that wait until a piece is done. */
void
AddSurplus(JobPlan & plan, const Request & request)
{
  const PieceSurplus & surplus = request.footprint.surplus;
  const std::uint64_t  perSlice = request.header.geometry.GetVoxelsPerSlice();
  const std::uint64_t  voxels = plan.GetMaximumSlices() * perSlice;
  const std::uint64_t  rest = plan.memory.limit - plan.memory.planned;
  const std::uint64_t  most = voxels * surplus.most + perSlice * surplus.mostOfSlice;
  plan.memory.surplus = std::min(rest / surplus.shareOfRest, most);
  plan.memory.surplusTakers = std::max<std::uint64_t>(1, request.footprint.surplusTakers);
  plan.memory.fixed += plan.memory.surplus;
  plan.memory.planned += std::min(plan.memory.surplus, voxels * surplus.planned);
}

[[noreturn]] void
RefuseLackOfMemory(const JobPlan & plan, const Request & request)
{
  const JobOptions & options = request.options;
  Fail(ExitStatus::Refused,
       "this volume needs at least ",
       FormatBytes(plan.memory.planned),
       " of memory with ",
       plan.threads,
       plan.threads == 1 ? " thread" : " threads",
       options.divisions ? " and " + std::to_string(plan.divisions) + " divisions" : "",
       ", ",
       FormatBytes(plan.memory.limit),
       " are allowed",
       request.footprint.keepsGrayValues ? "; walls measured on the object, with --sub-voxel=off, need less" : "",
       !request.header.compressed || !options.scratchFolder.empty()
         ? ""
         : "; it is compressed, and with --scratch DIR its " + FormatBytes(plan.memory.unpacked) +
             " of values need not be in memory");
}

} // namespace

JobPlan
FitToMemory(const JobOptions & options, const VolumeHeader & header, const Footprint & footprint)
{
  const Request       request{ options, header, footprint };
  const std::uint64_t free = options.memoryLimit ? 0 : GetFreeMemory();
  const std::uint64_t wanted = options.memoryLimit.value_or(free == NoMemoryLimit ? NoMemoryLimit : free / 2);
  JobPlan             plan;
  plan.threads = options.threads.value_or(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads());
  plan.numberOfSlices = header.geometry.size.back();
  plan.numberOfEngines = footprint.engines.size();
  plan.memory.unpacked = header.compressed ? header.GetStored().GetDataSize() : 0;
  plan.memory.limit = std::min(wanted, GetRestOfLimits());
  const bool fits = TryScratch(plan, request) || (!options.threads && TryFewerThreads(plan, request));
  if (!fits)
  {
    RefuseLackOfMemory(plan, request);
  }
  AddChunksToKeep(plan, request);
  AddSurplus(plan, request);
  plan.writesBehind = plan.writesBehind && !footprint.readsInput;
  return plan;
}

} // end namespace medialvoxel
