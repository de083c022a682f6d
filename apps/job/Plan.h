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
  std::uint64_t slabThickness{ 1 }; ///< slices that the filters process between two pulls of input
  std::uint64_t memoryBytes{ 0 };   ///< peak of the process for walls of up to PlannedWallThickness
  std::uint64_t memoryLimit{ 0 };   ///< that memoryBytes must not exceed

  std::filesystem::path scratchFolder;  ///< of the mask of a compressed volume; empty: it is in memory
  std::uint64_t         diskBytes{ 0 }; ///< of all outputs; with sparse outputs the most they can grow to

  SliceRange
  GetPiece(std::uint64_t piece) const;

  /** Slices of the largest piece. */
  std::uint64_t
  GetMaximumSlices() const;
};

/** Walls, in voxels, whose distances the planned windows hold; what thicker ones need cannot be known before. */
constexpr unsigned int PlannedWallThickness = 16;

/** What a filter keeps of its input: bits for the slices of a slab and for those around it. */
struct WindowFootprint
{
  std::uint64_t haloSlices{ 0 };
  std::uint64_t bitsPerVoxel{ 2 };
};

/** What a job keeps in memory at the same time. */
struct PieceFootprint
{
  std::uint64_t                bytesPerVoxel{ 1 }; ///< results of a piece
  std::vector<WindowFootprint> windows;
  std::uint64_t                bytesBeside{ 0 }; ///< what does not depend on pieces
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
