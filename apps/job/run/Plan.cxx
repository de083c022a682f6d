// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "FileNames.h"
#include "ReadVolumeHeader.h"
#include "SystemFile.h"
#include "Text.h"
#include "VolumeFormats.h"

#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <map>

namespace medialvoxel
{
namespace
{

std::uint64_t
GetOutputSize(const VolumeHeader & header, const OutputRequest & output)
{
  return output.layout ? GetOutputSize(output.fileName, header.geometry, *output.layout) : 0;
}

/** True for outputs whose space is taken from the disk before the start. */
bool
IsReserved(const JobOptions & options, const OutputRequest & output)
{
  return !options.sparse && !(output.IsVolume() && IsPackedInAnyWay(output.fileName, options));
}

/** Outputs and scratch files on one disk share its free space. */
void
RefuseLackOfSpace(const JobOptions &                 options,
                  const VolumeHeader &               header,
                  const std::vector<OutputRequest> & outputs,
                  const JobPlan &                    plan)
{
  const ScratchSpace        unpacked{ plan.scratchFolder, plan.scratchFolder.empty() ? 0 : plan.memory.unpacked };
  std::vector<ScratchSpace> files;
  for (const OutputRequest & output : outputs)
  {
    const std::uint64_t bytes = IsReserved(options, output) ? GetOutputSize(header, output) : 0;
    files.push_back({ FolderOf(output.fileName), bytes });
  }
  bool hasScratch = false;
  for (const ScratchSpace & scratch : { plan.growingScratch, unpacked })
  {
    if (scratch.bytes > 0 && !options.sparse)
    {
      files.push_back(scratch);
      hasScratch = true;
    }
  }
  std::map<std::uint64_t, std::uint64_t> needed;
  for (const auto & [folder, bytes] : files)
  {
    std::error_code error;
    const auto      space = std::filesystem::space(folder, error);
    const auto      status = GetFileStatus(folder);
    if (error || !status)
    {
      continue; // creating the file will tell
    }
    std::uint64_t & sum = needed[status->disk];
    sum += bytes;
    if (sum > space.free)
    {
      Fail(ExitStatus::Refused,
           "no space for the ",
           hasScratch ? "outputs and the scratch files" : "outputs",
           " in ",
           folder.string(),
           ": they need ",
           FormatBytes(sum),
           ", ",
           FormatBytes(space.free),
           " are free",
           hasScratch ? "; with --sparse this is not checked" : "");
    }
  }
}

} // namespace

JobPlan
MakePlan(const JobOptions &                 options,
         const VolumeHeader &               header,
         const std::vector<OutputRequest> & outputs,
         const Footprint &                  footprint)
{
  JobPlan plan = FitToMemory(options, header, footprint);
  plan.growingScratch = footprint.scratch;

  for (const OutputRequest & output : outputs)
  {
    plan.disk += GetOutputSize(header, output);
  }
  RefuseLackOfSpace(options, header, outputs, plan);
  return plan;
}

std::string
DescribeUnpacking(const JobPlan & plan)
{
  return FormatBytes(plan.memory.unpacked) + " in " +
         (plan.scratchFolder.empty() ? "memory" : plan.scratchFolder.string());
}

TextTable
DescribePlan(const JobPlan & plan, const VolumeHeader & header, const std::vector<OutputRequest> & outputs)
{
  TextTable table = DescribeHeader(header);
  table.emplace_back(
    "pieces",
    std::to_string(plan.divisions) + " of up to " + std::to_string(plan.GetMaximumSlices()) + " slices" +
      (plan.rowsAtOnce > 0
         ? ", " + std::to_string(plan.slicesAtOnce) + " slices of " + std::to_string(plan.rowsAtOnce) + " rows at once"
         : "") +
      (plan.slabThickness > 0 ? ", done in slabs of " + std::to_string(plan.slabThickness) : ""));
  table.emplace_back("threads", std::to_string(plan.threads));
  table.emplace_back("memory",
                     FormatBytes(plan.memory.planned) + " for walls of up to " + std::to_string(PlannedWallThickness) +
                       " voxels, up to " + FormatBytes(plan.memory.limit) + " for thicker ones");
  if (plan.memory.unpacked > 0)
  {
    table.emplace_back("unpacked", DescribeUnpacking(plan));
  }
  table.emplace_back("disk", FormatBytes(plan.disk));
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

} // end namespace medialvoxel
