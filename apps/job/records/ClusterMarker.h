// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelClusterMarker_h
#define medialvoxelClusterMarker_h

#include "Manifest.h"
#include "JobResult.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace medialvoxel
{

/** The record of a finished cluster, whose bytes are on the disk. */
struct ClusterMarker
{
  std::map<std::string, std::uint32_t> checksums; ///< CRC-32 of the cluster's voxels in each volume, by role
  std::optional<std::uint32_t>         survey;    ///< CRC-32 of the file with its part of the survey, if it has one
  itk::MedialVoxelSums                 sums;
  JobSeconds                           seconds;
  std::uint64_t                        bytesRead{ 0 };
  std::uint64_t                        peakMemory{ 0 };
  std::uint64_t                        plannedMemory{ 0 };
  std::uint64_t                        memoryLimit{ 0 };
  unsigned int                         threads{ 0 };
};

/** \throw JobError Failure */
void
WriteMarker(const std::filesystem::path & fileName,
            const Manifest &              manifest,
            std::uint64_t                 cluster,
            const ClusterMarker &         marker);

/** Nothing when the file is missing, damaged or of another job or cluster: then the cluster must be done. */
std::optional<ClusterMarker>
ReadMarker(const std::filesystem::path & fileName, const Manifest & manifest, std::uint64_t cluster);

} // end namespace medialvoxel

#endif
