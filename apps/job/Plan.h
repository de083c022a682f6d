// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlan_h
#define medialvoxelPlan_h

#include "Options.h"
#include "OutputChecks.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** Slices along the last axis, begin to end, the end excluded. */
struct SliceRange
{
  std::uint64_t begin{ 0 };
  std::uint64_t end{ 0 };
};

/** How a job will be done, decided before it starts. */
struct JobPlan
{
  std::uint64_t numberOfSlices{ 0 };
  std::uint64_t divisions{ 1 };
  unsigned int  threads{ 1 };
  std::uint64_t memoryBytes{ 0 }; ///< estimate of the peak for walls of up to about 20 voxels
  std::uint64_t diskBytes{ 0 };   ///< of all outputs; with sparse outputs the most they can grow to

  SliceRange
  GetPiece(std::uint64_t piece) const;
};

/** Bytes of results that each voxel of a piece keeps in memory at the same time. */
struct PieceFootprint
{
  std::uint64_t bytesPerVoxel{ 1 };
};

/** Divides the work so that it fits the memory.
 * \throw JobError Refused when it cannot, or when a disk has no space for the outputs. */
JobPlan
MakePlan(const JobOptions &                 options,
         const VolumeHeader &               header,
         const std::vector<OutputRequest> & outputs,
         const PieceFootprint &             footprint);

using TextTable = std::vector<std::pair<std::string, std::string>>;

/** The plan as names and values to print. */
TextTable
DescribePlan(const JobPlan & plan, const VolumeHeader & header, const std::vector<OutputRequest> & outputs);

/** The volume as names and values to print. */
TextTable
DescribeHeader(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
