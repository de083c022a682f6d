// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectSummary_h
#define medialvoxelObjectSummary_h

#include "Segments.h"
#include "ThicknessSummary.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** An object of a label map, with the numbers of a run with its label alone. */
struct ObjectSummary
{
  std::int64_t     label{ 0 };
  std::uint64_t    voxels{ 0 };
  std::uint64_t    candidateCells{ 0 };
  std::uint64_t    medialCells{ 0 };
  ThicknessSummary thickness;

  std::string                 name; ///< empty: it has none
  std::optional<SegmentColor> color;
};

/** All objects of a label map. */
struct LabelMapSummary
{
  std::vector<ObjectSummary> objects; ///< by label
  unsigned int               passes{ 0 };
  std::uint64_t              sharedCells{ 0 }; ///< medial for several objects
};

} // end namespace medialvoxel

#endif
