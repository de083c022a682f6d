// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "Text.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <map>
#include <sys/stat.h>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

// Measured on whole runs with thin walls, with a reserve of about a quarter.
constexpr std::uint64_t BytesOfProgram = 16 * MiB;
constexpr std::uint64_t BytesPerThread = 8 * MiB;
constexpr std::uint64_t BytesPerPull = 16 * MiB;
constexpr std::uint64_t SlicesOfWindow = 64;

/** Results of a piece when nothing else limits them: fewer slices per piece mean more that is read and done twice. */
constexpr std::uint64_t BytesOfPiece = 128 * MiB;

/** Memory that does not depend on the number of pieces. */
std::uint64_t
EstimateFixedMemory(const VolumeHeader & header, unsigned int threads)
{
  const std::uint64_t voxelsPerSlice = header.geometry.GetVoxelsPerSlice();
  const std::uint64_t bytesPerSlice = voxelsPerSlice * GetTraits(header.pixelType).bytes;
  const std::uint64_t windowSlices = std::min(header.geometry.size.back(), SlicesOfWindow);
  const std::uint64_t windowBytes = voxelsPerSlice * windowSlices * 3 / 8;
  const std::uint64_t inputBytes = header.CanStream()
                                     ? std::min(header.GetVoxelBytes(), std::max(BytesPerPull, bytesPerSlice))
                                     : header.GetVoxelBytes();
  return BytesOfProgram + BytesPerThread * threads + windowBytes + inputBytes;
}

std::uint64_t
CeilingDivide(std::uint64_t value, std::uint64_t divisor)
{
  return (value + divisor - 1) / divisor;
}

std::uint64_t
ChooseDivisions(const JobOptions & options,
                std::uint64_t      numberOfSlices,
                std::uint64_t      bytesPerSlice,
                std::uint64_t      fixedBytes)
{
  if (options.divisions)
  {
    return std::min(*options.divisions, numberOfSlices);
  }
  std::uint64_t budget = BytesOfPiece;
  if (options.memoryBytes)
  {
    budget = std::min(budget, *options.memoryBytes - std::min(*options.memoryBytes, fixedBytes));
  }
  const std::uint64_t slicesPerPiece = std::max<std::uint64_t>(1, budget / bytesPerSlice);
  return CeilingDivide(numberOfSlices, std::min(slicesPerPiece, numberOfSlices));
}

void
RefuseLackOfMemory(const JobOptions & options, const JobPlan & plan, std::uint64_t least)
{
  if (options.memoryBytes && plan.memoryBytes > *options.memoryBytes)
  {
    Fail(ExitStatus::Refused,
         "about ",
         FormatBytes(plan.memoryBytes),
         " of memory are needed, ",
         FormatBytes(*options.memoryBytes),
         " are allowed; with ",
         plan.threads,
         plan.threads == 1 ? " thread" : " threads",
         " this volume needs at least ",
         FormatBytes(least));
  }
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

JobPlan
MakePlan(const JobOptions &                 options,
         const VolumeHeader &               header,
         const std::vector<OutputRequest> & outputs,
         const PieceFootprint &             footprint)
{
  JobPlan plan;
  plan.threads = GetNumberOfThreads(options);
  plan.numberOfSlices = header.geometry.size.back();
  const std::uint64_t bytesPerSlice = header.geometry.GetVoxelsPerSlice() * footprint.bytesPerVoxel;
  const std::uint64_t fixedBytes = EstimateFixedMemory(header, plan.threads);
  plan.divisions = ChooseDivisions(options, plan.numberOfSlices, bytesPerSlice, fixedBytes);
  plan.memoryBytes = fixedBytes + CeilingDivide(plan.numberOfSlices, plan.divisions) * bytesPerSlice;
  RefuseLackOfMemory(options, plan, fixedBytes + bytesPerSlice);

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
                     std::to_string(plan.divisions) + " of up to " +
                       std::to_string(CeilingDivide(plan.numberOfSlices, plan.divisions)) + " slices");
  table.emplace_back("threads", std::to_string(plan.threads));
  table.emplace_back("memory", "about " + FormatBytes(plan.memoryBytes));
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
  table.emplace_back("reading",
                     header.CanStream() ? "streams: parts are read as they are needed"
                                        : "does not stream: it is compressed and unpacked whole into memory");
  return table;
}

} // end namespace medialvoxel
