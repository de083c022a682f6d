// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetCleaning_h
#define medialvoxelSheetCleaning_h

#include "MeshSpool.h"
#include "SheetSummary.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace medialvoxel
{

/** Limits of the branches and components that stay in a complete sheet, and the resources for it. */
struct SheetCleaning
{
  double                      minimumBranchLength{ 0 };  ///< physical units; 0: branches stay
  std::uint64_t               minimumComponentSize{ 0 }; ///< quadrilaterals; 0 and 1: components stay
  std::filesystem::path       scratchFolder;             ///< of the result
  std::uint64_t               memoryLimit{ 0 };          ///< that may be taken
  std::function<void(double)> progress;                  ///< called often; may throw to stop

  bool
  IsOn() const
  {
    return minimumBranchLength > 0 || minimumComponentSize > 1;
  }
};

/** The surface without short branches, and then without small components. Its faces are quadrilaterals, or pairs of
 * triangles of which each is one. There are two spools at a time, and memory for every vertex and face.
 * \param pieces what is left out of small components, where they are
 * \throw JobError Refused when that is more memory than allowed */
std::unique_ptr<MeshSpool>
CleanSheet(std::unique_ptr<MeshSpool> surface, const SheetCleaning & cleaning, std::optional<PiecesLeftOut> & pieces);

/** Memory that cleaning takes for so many vertices and as many faces. */
std::uint64_t
GetCleaningMemory(const SheetCleaning & cleaning, std::uint64_t vertices);

} // end namespace medialvoxel

#endif
