// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "BitStore.h"
#include "MemoryPlan.h"
#include "Text.h"

#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <map>
#include <sys/stat.h>

namespace medialvoxel
{
namespace
{

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

/** True for outputs whose space is taken from the disk before the start. */
bool
IsReserved(const JobOptions & options, const OutputRequest & output)
{
  const bool isPacked = output.layout && IsPackedVolume(output.fileName, options.compress);
  return !options.sparse && !isPacked && (!IsZarrOutput(output) || options.zarrCompression == ZarrCompression::None);
}

/** Outputs and scratch files on one disk share its free space. */
void
RefuseLackOfSpace(const JobOptions &                 options,
                  const VolumeHeader &               header,
                  const std::vector<OutputRequest> & outputs,
                  const ScratchSpace &               scratch)
{
  std::vector<ScratchSpace> files;
  for (const OutputRequest & output : outputs)
  {
    const std::uint64_t bytes = IsReserved(options, output) ? GetOutputBytes(header, output) : 0;
    files.push_back({ GetFolder(output.fileName), bytes });
  }
  if (scratch.bytes > 0 && !options.sparse)
  {
    files.push_back(scratch);
  }
  std::map<dev_t, std::uint64_t> needed;
  for (const auto & [folder, bytes] : files)
  {
    struct stat     status = {};
    std::error_code error;
    const auto      space = std::filesystem::space(folder, error);
    if (error || stat(folder.c_str(), &status) != 0)
    {
      continue; // creating the file will tell
    }
    std::uint64_t & sum = needed[status.st_dev];
    sum += bytes;
    if (sum > space.free)
    {
      Fail(ExitStatus::Refused,
           "no space for the ",
           scratch.bytes > 0 ? "outputs and the scratch files of the mesh" : "outputs",
           " in ",
           folder.string(),
           ": they need ",
           FormatBytes(sum),
           ", ",
           FormatBytes(space.free),
           " are free",
           scratch.bytes > 0 ? "; with --sparse this is not checked" : "");
    }
  }
}

} // namespace

SliceRange
JobPlan::GetPiece(std::uint64_t piece) const
{
  // None is larger than the one before, so that the memory of its results serves again.
  const std::uint64_t units = this->GetNumberOfUnits();
  const std::uint64_t perPiece = units / divisions;
  const std::uint64_t largerPieces = units % divisions;
  const std::uint64_t begin = piece * perPiece + std::min(piece, largerPieces);
  const std::uint64_t end = begin + perPiece + (piece < largerPieces ? 1 : 0);
  return { begin * sliceUnit, std::min(end * sliceUnit, numberOfSlices) };
}

std::uint64_t
JobPlan::GetFilterLimit(std::uint64_t slices) const
{
  if (memoryLimit == NoMemoryLimit)
  {
    return 0;
  }
  const std::uint64_t other = fixedBytes + this->GetResultBytes(slices);
  return std::max<std::uint64_t>(1, (memoryLimit - std::min(memoryLimit, other)) / numberOfFilters);
}

std::uint64_t
JobPlan::GetMaximumSlices() const
{
  return this->GetPiece(0).end;
}

JobPlan
MakePlan(const JobOptions &                 options,
         const VolumeHeader &               header,
         const std::vector<OutputRequest> & outputs,
         const PieceFootprint &             footprint)
{
  JobPlan plan = FitToMemory(options, header, footprint);
  plan.growingScratch = footprint.scratch;

  for (const OutputRequest & output : outputs)
  {
    plan.diskBytes += GetOutputBytes(header, output);
  }
  RefuseLackOfSpace(options, header, outputs, footprint.scratch);
  return plan;
}

TextTable
DescribePlan(const JobPlan & plan, const VolumeHeader & header, const std::vector<OutputRequest> & outputs)
{
  TextTable table = DescribeHeader(header);
  table.emplace_back("pieces",
                     std::to_string(plan.divisions) + " of up to " + std::to_string(plan.GetMaximumSlices()) +
                       " slices" +
                       (plan.slabThickness > 0 ? ", done in slabs of " + std::to_string(plan.slabThickness) : ""));
  table.emplace_back("threads", std::to_string(plan.threads));
  table.emplace_back("memory",
                     FormatBytes(plan.memoryBytes) + " for walls of up to " + std::to_string(PlannedWallThickness) +
                       " voxels, up to " + FormatBytes(plan.memoryLimit) + " for thicker ones");
  if (!header.CanStream())
  {
    const std::string mask = FormatBytes(GetBitStoreBytes(header.geometry.GetNumberOfVoxels()));
    table.emplace_back("mask",
                       mask + (plan.scratchFolder.empty() ? " in memory" : " in " + plan.scratchFolder.string()));
  }
  table.emplace_back("disk", FormatBytes(plan.diskBytes));
  if (plan.growingScratch.bytes > 0)
  {
    table.emplace_back(
      "scratch", "about " + FormatBytes(plan.growingScratch.bytes) + " in " + plan.growingScratch.folder.string());
  }
  for (const OutputRequest & output : outputs)
  {
    table.emplace_back(output.role, output.fileName.string());
  }
  return table;
}

TextTable
DescribeHeader(const VolumeHeader & seen)
{
  const VolumeHeader &         header = seen.GetStored();
  const VolumeGeometry * const resampled = seen.stored ? &seen.geometry : nullptr;
  TextTable                    table;
  table.emplace_back("file", header.fileName.string());
  table.emplace_back("format", header.format);
  table.emplace_back("size", FormatSize(header.geometry.size));
  table.emplace_back("spacing", FormatNumbers(header.geometry.spacing, " x "));
  table.emplace_back("origin", FormatNumbers(header.geometry.origin, ", "));
  if (resampled)
  {
    table.emplace_back("resampled", FormatSize(resampled->size) + " at " + FormatNumbers(resampled->spacing, " x "));
  }
  table.emplace_back("type", std::string(GetTraits(header.pixelType).name));
  table.emplace_back("voxels", std::to_string(header.geometry.GetNumberOfVoxels()));
  table.emplace_back("bytes",
                     std::to_string(header.GetVoxelBytes()) + " (" + FormatBytes(header.GetVoxelBytes()) + ")");
  if (header.dataFile != header.fileName)
  {
    table.emplace_back("data file", itk::MedialVoxelText::MakePrintable(header.dataFile.string()));
  }
  table.emplace_back("reading", header.DescribeReading());
  return table;
}

} // end namespace medialvoxel
