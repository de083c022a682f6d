// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "BitStore.h"
#include "Text.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <sys/stat.h>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

// Measured on whole runs with thin walls: the process without work, and the tiles of a thread.
constexpr std::uint64_t BytesOfProgram = 14 * MiB;
constexpr std::uint64_t BytesPerThread = 5 * MiB;

/** The filter pulls input in whole slices of at least this many bytes. */
constexpr std::uint64_t BytesPerPull = 4 * MiB;

/** Results of a piece when nothing else limits them. */
constexpr std::uint64_t BytesOfPiece = 128 * MiB;

/** Edges of the filter's tiles across the slices, and the number of tiles that keeps threads busy. */
constexpr std::uint64_t TileWidth = 128;
constexpr std::uint64_t TileEdge = 32;
constexpr std::uint64_t EnoughTiles = 64;

std::uint64_t
CeilingDivide(std::uint64_t value, std::uint64_t divisor)
{
  return (value + divisor - 1) / divisor;
}

/** Bytes of one bit per voxel of a slice; each row is padded by a word at both ends. */
std::uint64_t
GetBitsPerSlice(const VolumeGeometry & geometry)
{
  const std::uint64_t words = CeilingDivide(geometry.size.front(), BitStore::BitsPerWord) + 2;
  return words * sizeof(BitStore::WordType) * (geometry.GetVoxelsPerSlice() / geometry.size.front());
}

/** Bytes of all windows on the input. */
std::uint64_t
EstimateWindows(const VolumeHeader & header, const PieceFootprint & footprint, std::uint64_t slabThickness)
{
  std::uint64_t bytes = 0;
  for (const WindowFootprint & window : footprint.windows)
  {
    const std::uint64_t slices = std::min(header.geometry.size.back(), slabThickness + 2 * window.haloSlices);
    bytes += slices * window.bitsPerVoxel * GetBitsPerSlice(header.geometry);
  }
  return bytes;
}

/** Memory that does not depend on the number of pieces. */
std::uint64_t
EstimateFixedMemory(const JobPlan & plan, const VolumeHeader & header, const PieceFootprint & footprint)
{
  const bool          isMask = !header.CanStream();
  const std::uint64_t bytesPerVoxel = isMask ? 1 : GetTraits(header.pixelType).bytes;
  const std::uint64_t voxels = header.geometry.GetNumberOfVoxels();
  const std::uint64_t pull = std::max(BytesPerPull, header.geometry.GetVoxelsPerSlice() * bytesPerVoxel);
  const std::uint64_t mask = isMask && plan.scratchFolder.empty() ? GetBitStoreBytes(voxels) : 0;
  return BytesOfProgram + BytesPerThread * plan.threads + std::min(pull, voxels * bytesPerVoxel) + mask +
         footprint.bytesBeside + EstimateWindows(header, footprint, plan.slabThickness);
}

/** Slices that keep the threads busy between two pulls. */
std::uint64_t
GetPreferredSlabThickness(const VolumeGeometry & geometry)
{
  const std::uint64_t rows = geometry.GetVoxelsPerSlice() / geometry.size.front();
  const std::uint64_t tiles = CeilingDivide(geometry.size.front(), TileWidth) * CeilingDivide(rows, TileEdge);
  return std::min(geometry.size.back(), TileEdge * CeilingDivide(EnoughTiles, tiles));
}

/** Divides the slices for the threads, slabs and scratch folder of the plan; true when that fits. */
bool
TryDivisions(JobPlan & plan, const JobOptions & options, const VolumeHeader & header, const PieceFootprint & footprint)
{
  const std::uint64_t bytesPerSlice = header.geometry.GetVoxelsPerSlice() * footprint.bytesPerVoxel;
  const std::uint64_t fixed = EstimateFixedMemory(plan, header, footprint);
  const std::uint64_t rest = plan.memoryLimit - std::min(plan.memoryLimit, fixed);
  if (options.divisions)
  {
    plan.divisions = std::min(*options.divisions, plan.numberOfSlices);
  }
  else
  {
    const std::uint64_t most = std::max<std::uint64_t>(1, BytesOfPiece / bytesPerSlice);
    const std::uint64_t slices = std::max(std::min(plan.slabThickness, most), std::min(rest / bytesPerSlice, most));
    plan.divisions = CeilingDivide(plan.numberOfSlices, std::min(slices, plan.numberOfSlices));
  }
  plan.memoryBytes = fixed + plan.GetMaximumSlices() * bytesPerSlice;
  return plan.memoryBytes <= plan.memoryLimit;
}

/** Thinner slabs read and do more twice, so that the thickest that fit are taken. */
bool
TrySlabs(JobPlan & plan, const JobOptions & options, const VolumeHeader & header, const PieceFootprint & footprint)
{
  for (plan.slabThickness = GetPreferredSlabThickness(header.geometry);; plan.slabThickness /= 2)
  {
    if (TryDivisions(plan, options, header, footprint))
    {
      return true;
    }
    if (plan.slabThickness == 1)
    {
      return false;
    }
  }
}

/** A mask is in memory when that fits, otherwise in the scratch folder if there is one. */
bool
TryScratch(JobPlan & plan, const JobOptions & options, const VolumeHeader & header, const PieceFootprint & footprint)
{
  plan.scratchFolder.clear();
  if (TrySlabs(plan, options, header, footprint))
  {
    return true;
  }
  if (header.CanStream() || options.scratchFolder.empty())
  {
    return false;
  }
  plan.scratchFolder = options.scratchFolder;
  return TrySlabs(plan, options, header, footprint);
}

void
FitToMemory(JobPlan & plan, const JobOptions & options, const VolumeHeader & header, const PieceFootprint & footprint)
{
  if (TryScratch(plan, options, header, footprint))
  {
    return;
  }
  if (!options.threads)
  {
    plan.threads = 1;
    if (TryScratch(plan, options, header, footprint))
    {
      return;
    }
  }
  Fail(ExitStatus::Refused,
       "this volume needs at least ",
       FormatBytes(plan.memoryBytes),
       " of memory with ",
       plan.threads,
       plan.threads == 1 ? " thread" : " threads",
       options.divisions ? " and " + std::to_string(plan.divisions) + " divisions" : "",
       ", ",
       FormatBytes(plan.memoryLimit),
       " are allowed",
       header.CanStream() || !options.scratchFolder.empty()
         ? ""
         : "; it is compressed, and with --scratch DIR its mask need not be in memory");
}

/** Half of what the system could give without swapping; without limit where it does not tell. */
std::uint64_t
GetDefaultMemoryLimit()
{
  std::ifstream information("/proc/meminfo");
  std::string   line;
  while (std::getline(information, line))
  {
    const std::vector<std::string> parts = SplitAtBlanks(line);
    if (parts.size() >= 2 && parts[0] == "MemAvailable:")
    {
      return static_cast<std::uint64_t>(ParseInteger(parts[1]).value_or(0)) * 1024 / 2;
    }
  }
  return std::numeric_limits<std::uint64_t>::max();
}

std::uint64_t
GetOutputBytes(const VolumeHeader & header, const OutputRequest & output)
{
  return output.layout ? header.geometry.GetNumberOfVoxels() * output.layout->GetBytes() : 0;
}

std::filesystem::path
GetFolder(const std::filesystem::path & fileName)
{
  return fileName.has_parent_path() ? fileName.parent_path() : std::filesystem::path(".");
}

/** Outputs on one disk share its free space. */
void
RefuseLackOfSpace(const VolumeHeader & header, const std::vector<OutputRequest> & outputs)
{
  std::map<dev_t, std::uint64_t> needed;
  for (const OutputRequest & output : outputs)
  {
    const std::filesystem::path folder = GetFolder(output.fileName);
    struct stat                 status = {};
    std::error_code             error;
    const auto                  space = std::filesystem::space(folder, error);
    if (error || stat(folder.c_str(), &status) != 0)
    {
      continue; // creating the file will tell
    }
    std::uint64_t & sum = needed[status.st_dev];
    sum += GetOutputBytes(header, output);
    if (sum > space.free)
    {
      Fail(ExitStatus::Refused,
           "no space for the outputs in ",
           folder.string(),
           ": they need ",
           FormatBytes(sum),
           ", ",
           FormatBytes(space.free),
           " are free");
    }
  }
}

unsigned int
GetNumberOfThreads(const JobOptions & options)
{
  return options.threads.value_or(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads());
}

} // namespace

SliceRange
JobPlan::GetPiece(std::uint64_t piece) const
{
  return { piece * numberOfSlices / divisions, (piece + 1) * numberOfSlices / divisions };
}

std::uint64_t
JobPlan::GetMaximumSlices() const
{
  return CeilingDivide(numberOfSlices, divisions);
}

JobPlan
MakePlan(const JobOptions &                 options,
         const VolumeHeader &               header,
         const std::vector<OutputRequest> & outputs,
         const PieceFootprint &             footprint)
{
  JobPlan plan;
  plan.threads = GetNumberOfThreads(options);
  plan.numberOfSlices = header.geometry.size.back();
  plan.memoryLimit = options.memoryBytes ? *options.memoryBytes : GetDefaultMemoryLimit();
  FitToMemory(plan, options, header, footprint);

  for (const OutputRequest & output : outputs)
  {
    plan.diskBytes += GetOutputBytes(header, output);
  }
  if (!options.sparse)
  {
    RefuseLackOfSpace(header, outputs);
  }
  return plan;
}

TextTable
DescribePlan(const JobPlan & plan, const VolumeHeader & header, const std::vector<OutputRequest> & outputs)
{
  TextTable table = DescribeHeader(header);
  table.emplace_back("pieces",
                     std::to_string(plan.divisions) + " of up to " + std::to_string(plan.GetMaximumSlices()) +
                       " slices, done in slabs of " + std::to_string(plan.slabThickness));
  table.emplace_back("threads", std::to_string(plan.threads));
  table.emplace_back("memory",
                     "up to " + FormatBytes(plan.memoryBytes) + " for walls of up to " +
                       std::to_string(PlannedWallThickness) + " voxels, more for thicker ones; allowed are " +
                       FormatBytes(plan.memoryLimit));
  if (!header.CanStream())
  {
    const std::string mask = FormatBytes(GetBitStoreBytes(header.geometry.GetNumberOfVoxels()));
    table.emplace_back("mask",
                       mask + (plan.scratchFolder.empty() ? " in memory" : " in " + plan.scratchFolder.string()));
  }
  table.emplace_back("disk", FormatBytes(plan.diskBytes));
  for (const OutputRequest & output : outputs)
  {
    table.emplace_back(output.role, output.fileName.string());
  }
  return table;
}

TextTable
DescribeHeader(const VolumeHeader & header)
{
  TextTable table;
  table.emplace_back("file", header.fileName.string());
  table.emplace_back("format", header.format);
  table.emplace_back("size", FormatSize(header.geometry.size));
  table.emplace_back("spacing", FormatNumbers(header.geometry.spacing, " x "));
  table.emplace_back("origin", FormatNumbers(header.geometry.origin, ", "));
  table.emplace_back("type", std::string(GetTraits(header.pixelType).name));
  table.emplace_back("voxels", std::to_string(header.geometry.GetNumberOfVoxels()));
  table.emplace_back("bytes",
                     std::to_string(header.GetVoxelBytes()) + " (" + FormatBytes(header.GetVoxelBytes()) + ")");
  if (header.dataFile != header.fileName)
  {
    table.emplace_back("data file", header.dataFile.string());
  }
  table.emplace_back("reading", header.DescribeReading());
  return table;
}

} // end namespace medialvoxel
