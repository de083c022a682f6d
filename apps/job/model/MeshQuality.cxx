// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshQuality.h"

namespace medialvoxel
{

std::vector<MeshLimit>
ListMeshLimits(const MeshQuality & quality)
{
  const auto number = [](const std::uint64_t count) { return static_cast<double>(count); };
  return { { "elements without a positive Jacobian", number(quality.shapes.notPositive), 0, false },
           { "scaled Jacobian of 99 %", quality.shapes.lowJacobian, 0.3, true },
           { "aspect ratio of 99 %", quality.shapes.highAspect, 5, false },
           { "nodes at one place", number(quality.sameNodes), 0, false },
           { "elements with the same nodes", number(quality.sameElements), 0, false },
           { "hanging nodes", number(quality.hangingNodes), 0, false },
           { "walls turned both ways", number(quality.turnedWalls), 0, false } };
}

} // end namespace medialvoxel
