// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshCheck_h
#define medialvoxelMeshCheck_h

#include "MeshFile.h"
#include "Text.h"

#include "itkMedialVoxelElementQuality.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** What solvers ask of a shell mesh. Scaled Jacobian and aspect ratio are those of the Verdict library. */
struct MeshCheck
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

/** One line of the table of limits. */
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

MeshCheck
CheckMesh(const MeshFile & mesh);

/** No element without a positive Jacobian, 0.3 and an aspect ratio of 5 for 99 % of them, nothing twice, no hanging
 * node, and walls that are turned one way where they can be. */
std::vector<MeshLimit>
ListMeshLimits(const MeshCheck & check);

TextTable
DescribeMeshCheck(const MeshCheck & check);

/** The same numbers as JSON, with the limits and whether they hold. */
std::string
MakeMeshCheckJson(const std::string & fileName, const MeshCheck & check);

} // end namespace medialvoxel

#endif
