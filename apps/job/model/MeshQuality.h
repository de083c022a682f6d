// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshQuality_h
#define medialvoxelMeshQuality_h

#include "itkMedialVoxelElementQuality.h"

#include <cstdint>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Requirements of solvers on a shell mesh. Scaled Jacobian and aspect ratio are defined as in the Verdict library.
 * `_check.py` of the Python package measures the same. */
struct MeshQuality
{
  std::uint64_t nodes{ 0 }; ///< of elements
  std::uint64_t triangles{ 0 };
  std::uint64_t quads{ 0 };
  std::uint64_t sameNodes{ 0 };     ///< nodes at the place of another one
  std::uint64_t sameElements{ 0 };  ///< elements with the nodes of another one
  std::uint64_t hangingNodes{ 0 };  ///< nodes at rims that lie on a side of another element
  std::uint64_t rimSides{ 0 };      ///< of one element
  std::uint64_t junctionSides{ 0 }; ///< of more than two
  std::uint64_t walls{ 0 };         ///< that sides of two elements join
  std::uint64_t oneSidedWalls{ 0 }; ///< whose elements can not all be turned one way round
  std::uint64_t turnedWalls{ 0 };   ///< whose elements could, and are not

  itk::MedialVoxelShapeSummary shapes;
};

/** A value of the quality that has a limit. */
struct MeshLimit
{
  std::string name;
  double      value;
  double      limit;
  bool        isLeast; ///< the value has to reach the limit; else not to exceed it

  bool
  Holds() const
  {
    return isLeast ? value >= limit : value <= limit;
  }
};

/** No element without a positive Jacobian, 0.3 and an aspect ratio of 5 for 99 % of them, nothing twice, no hanging
 * node, and walls that are turned one way where they can be. */
std::vector<MeshLimit>
ListMeshLimits(const MeshQuality & quality);

} // end namespace medialvoxel

#endif
