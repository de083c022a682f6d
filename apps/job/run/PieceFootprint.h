// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPieceFootprint_h
#define medialvoxelPieceFootprint_h

#include "JobPlan.h"
#include "Options.h"
#include "OutputRequest.h"

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelGrid.h"

#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** What a piece finds and keeps until it is done, in bytes for each of its voxels. Pieces that find more than memory
 * allows are done in smaller ones. */
struct PieceSurplus
{
  std::uint64_t mostBytesPerVoxel{ 0 };
  std::uint64_t plannedBytesPerVoxel{ 0 };
  std::uint64_t mostBytesPerVoxelOfSlice{ 0 }; ///< of a piece of one slice, beside the first
  std::uint64_t shareOfRest{ 4 };              ///< it takes one of so many parts of the memory that is left
};

/** What a job keeps in memory at the same time, and on the disk beside its outputs. */
struct PieceFootprint
{
  std::uint64_t        bytesPerVoxel{ 1 };   ///< results of a piece
  std::uint64_t        bytesBeside{ 0 };     ///< what does not depend on pieces
  std::uint64_t        bytesPerThread{ 0 };  ///< of threads that read, beside what they always take
  PieceSurplus         surplus;              ///< what waits for its piece to be done
  std::uint64_t        preferredSlices{ 1 }; ///< pieces have a multiple of it where they can: a layer of chunks
  std::uint64_t        preferredRows{ 0 };   ///< of slices that may be done in rows, a multiple of it; 0: as a whole
  itk::MedialVoxelGrid grid;
  ScratchSpace         scratch; ///< of files that grow with the results

  /** Of the engines that take turns on each piece and keep their windows. */
  std::vector<itk::MedialVoxelEngineSettings> engines;
};

/** Bytes of a voxel in the volumes that an engine makes, whose results for a piece are kept together; at least 1. */
std::uint64_t
GetBytesPerVoxel(const std::vector<VolumeRequest> & volumes, VolumeFiller filler);

/** Counts in an engine on the volume of the header. */
void
AddEngine(PieceFootprint & footprint, const VolumeHeader & header, const itk::MedialVoxelEngineTask & task);

/** Slices that the outputs write together: a layer of chunks. */
std::uint64_t
GetSlicesOfLayer(const VolumeHeader & header, const std::vector<OutputRequest> & outputs);

/** Rows of slices that all volumes write together: those of chunks; 0 when some are written slice by slice. */
std::uint64_t
GetRowsOfLayer(const VolumeHeader & header, const std::vector<OutputRequest> & outputs);

/** Counts in what outputs take beside the results of a piece. */
void
AddOutputs(PieceFootprint &                   footprint,
           const JobOptions &                 options,
           const VolumeHeader &               header,
           const std::vector<OutputRequest> & outputs);

} // end namespace medialvoxel

#endif
