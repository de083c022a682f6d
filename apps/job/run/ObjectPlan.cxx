// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectPlan.h"

#include "Job.h"
#include "LabelMap.h"
#include "LabelMapRun.h"
#include "Plan.h"

#include <algorithm>
#include <string>

namespace medialvoxel
{
namespace
{

std::string
DescribeReadingOfLabels(const itk::MedialVoxelObjectMap & map, const JobPlan & plan, const VolumeHeader & header)
{
  if (header.compressed)
  {
    return "unpacked once, " + FormatBytes(plan.memory.unpacked) + " in memory or with --scratch DIR on the disk";
  }
  const unsigned int passes = map.GetNumberOfPasses();
  return "streamed, each part " + std::to_string(passes + 1) + " times: to find the objects, and in each pass";
}

/** Voxels and label of one of the objects. */
std::string
DescribeSize(const itk::MedialVoxelObjectMap & map, std::vector<std::uint64_t>::const_iterator voxels)
{
  const auto number = static_cast<itk::MedialVoxelObjectNumber>(voxels - map.GetObjectVoxels().begin());
  return std::to_string(*voxels) + " voxels (label " + std::to_string(map.GetTable().GetValue(number)) + ")";
}

} // namespace

TextTable
DescribeObjects(const JobOptions & options, const VolumeHeader & header, const ReadObserver & observer)
{
  ExtractOptions own;
  static_cast<JobOptions &>(own) = options;
  own.labels = LabelSelection{ true, {}, {} };
  const std::uint64_t maximumPoreSize = GetParameters(own, GetGrid(header)).maximumPoreSize;

  const JobPlan plan = FitToMemory(own, header, Job(own, header).GetFootprint());
  LabelMap      volume(header, *own.labels, maximumPoreSize, plan.memory.toKeep);
  volume.Prepare(observer);
  const itk::MedialVoxelObjectMap & map = volume.GetObjects();

  const std::vector<std::int64_t> & labels = map.GetTable().GetValues();
  const auto                        firstObject = map.GetObjectVoxels().begin() + 1;
  return {
    { "objects",
      std::to_string(labels.size()) + ", labels " + std::to_string(labels.front()) + " to " +
        std::to_string(labels.back()) },
    { "smallest", DescribeSize(map, std::min_element(firstObject, map.GetObjectVoxels().end())) },
    { "largest", DescribeSize(map, std::max_element(firstObject, map.GetObjectVoxels().end())) },
    { "passes", std::to_string(map.GetNumberOfPasses()) + " for extract --labels all" },
    { "labels", DescribeReadingOfLabels(map, plan, header) },
    { "memory",
      "about " + FormatBytes(plan.memory.planned + LabelMapRun::GetUnplannedMemory(*own.labels, labels.size())) +
        " with " + std::to_string(plan.threads) + " threads" },
  };
}

} // end namespace medialvoxel
