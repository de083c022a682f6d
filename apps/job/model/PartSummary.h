// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPartSummary_h
#define medialvoxelPartSummary_h

#include "ThicknessSummary.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** A thickness over the surface of a part, without caps and where it is not known. Lengths and areas are physical. */
struct ThicknessOfSurface : ThicknessStatistics ///< by area
{
  std::uint64_t unknownVertices{ 0 }; ///< at which it is not known
  double        area{ 0.0 };          ///< at which it is known
  AreaBins      bins;
};

/** Rays without an answer, by what ends them. */
struct UnansweredRays
{
  std::uint64_t leaveVolume{ 0 }; ///< or start outside of it, at a cap
  std::uint64_t tooLong{ 0 };
  std::uint64_t unknown{ 0 }; ///< no direction, or values that are not a number

  std::uint64_t
  GetTotal() const
  {
    return leaveVolume + tooLong + unknown;
  }
};

/** What a report tells of the surface of a part. */
struct PartSummary
{
  std::uint64_t vertices{ 0 };
  std::uint64_t triangles{ 0 };
  bool          usesGrayValues{ false }; ///< to place the vertices; otherwise they are in the middle between voxels
  double        area{ 0.0 };             ///< of all triangles
  double        capArea{ 0.0 };          ///< of those that close it where the volume cuts the part

  std::optional<double>                volume;     ///< enclosed; of a closed surface
  std::optional<std::array<double, 2>> colorRange; ///< thickness of the first and the last color, when some is known

  ThicknessOfSurface                thickness;
  std::optional<ThicknessOfSurface> rays; ///< when they were measured
  UnansweredRays                    unansweredRays;
};

} // end namespace medialvoxel

#endif
