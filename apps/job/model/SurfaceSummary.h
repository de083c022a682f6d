// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurfaceSummary_h
#define medialvoxelSurfaceSummary_h

#include <cstdint>

namespace medialvoxel
{

/** What a report tells of a medial surface. */
struct SurfaceSummary
{
  std::uint64_t vertices{ 0 };
  std::uint64_t faces{ 0 };
  double        area{ 0 }; ///< physical units squared
};

} // end namespace medialvoxel

#endif
