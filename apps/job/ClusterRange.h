// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelClusterRange_h
#define medialvoxelClusterRange_h

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Clusters of a job, which count from 0; the last one belongs to it. */
struct ClusterRange
{
  std::uint64_t first{ 0 };
  std::uint64_t last{ 0 };
};

/** Ranges such as "3", "0-9" or "0-3,7"; nothing for other texts. */
std::optional<std::vector<ClusterRange>>
ParseClusters(const std::string & text);

/** The text of clusters that are in order and differ, as short as it can be. */
std::string
FormatClusters(const std::vector<std::uint64_t> & clusters);

/** The clusters of the ranges in order, each once; all of them without ranges.
 * \throw JobError Usage for a cluster that the job does not have. */
std::vector<std::uint64_t>
ListClusters(const std::vector<ClusterRange> & ranges, std::uint64_t numberOfClusters);

} // end namespace medialvoxel

#endif
