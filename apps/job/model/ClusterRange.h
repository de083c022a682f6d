// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelClusterRange_h
#define medialvoxelClusterRange_h

#include <cstdint>
#include <optional>
#include <set>
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

/** Parses ranges like "3", "0-9" or "0-3,7"; nothing for other texts. */
std::optional<std::vector<ClusterRange>>
ParseClusters(const std::string & text);

/** The text of clusters that are in order and differ, as short as it can be. */
std::string
FormatClusters(const std::vector<std::uint64_t> & clusters);

/** The clusters of the ranges in order, each once; all of them without ranges.
 * \throw JobError Usage for a cluster that the job does not have. */
std::vector<std::uint64_t>
ListClusters(const std::vector<ClusterRange> & ranges, std::uint64_t numberOfClusters);

/** The cluster that a process should do next, so that clusters which follow each other are done by one process, which
 * reads their common neighborhood once: the one behind its last one if it is free; otherwise the longest run of free
 * ones, from its begin, or from its middle when another process is coming from there.
 * \param free not empty
 * \param busy clusters that other processes are at
 * \param last that this process has done */
std::uint64_t
ChooseCluster(const std::set<std::uint64_t> &      free,
              const std::set<std::uint64_t> &      busy,
              const std::optional<std::uint64_t> & last);

} // end namespace medialvoxel

#endif
