// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProductFootprint_h
#define medialvoxelProductFootprint_h

#include "JobPlan.h"

#include <cstdint>

namespace medialvoxel
{

/** Bytes of results that a piece keeps until it is done, for each of its voxels. Pieces that exceed the memory are
 * done in smaller ones. */
struct PieceSurplus
{
  std::uint64_t most{ 0 };
  std::uint64_t planned{ 0 };
  std::uint64_t mostOfSlice{ 0 }; ///< of a piece of one slice, beside the first
  std::uint64_t shareOfRest{ 4 }; ///< it takes one of so many parts of the memory that is left
};

/** Bytes of a product in a run. */
struct ProductFootprint
{
  std::uint64_t beside{ 0 };         ///< independent of pieces
  std::uint64_t saving{ 0 };         ///< beside, while it is saved for another process
  std::uint64_t perVoxelOfTile{ 0 }; ///< of a worker, of who sees the tiles
  PieceSurplus  surplus{};
  ScratchSpace  scratch{};
};

} // end namespace medialvoxel

#endif
