// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProductFootprint_h
#define medialvoxelProductFootprint_h

#include "JobPlan.h"

#include <cstdint>

namespace medialvoxel
{

/** What a piece finds and keeps until it is done, in bytes for each of its voxels. Pieces that find more than memory
 * allows are done in smaller ones. */
struct PieceSurplus
{
  std::uint64_t most{ 0 };
  std::uint64_t planned{ 0 };
  std::uint64_t mostOfSlice{ 0 }; ///< of a piece of one slice, beside the first
  std::uint64_t shareOfRest{ 4 }; ///< it takes one of so many parts of the memory that is left
};

/** What takes part in a run, in bytes. */
struct ProductFootprint
{
  std::uint64_t beside{ 0 };         ///< what does not depend on pieces
  std::uint64_t saving{ 0 };         ///< beside, while it is saved for another process
  std::uint64_t perVoxelOfTile{ 0 }; ///< of a worker, of who sees the tiles
  PieceSurplus  surplus{};
  ScratchSpace  scratch{};
};

} // end namespace medialvoxel

#endif
