// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshElements.h"

#include "itkMedialVoxelVector3.h"

#include <cmath>

namespace medialvoxel
{
namespace
{

/** Smaller sines of corners make an element that solvers refuse: about 12 degrees from flat or from a spike. */
constexpr double SmallestSine = 0.2;

const MeshElements OneTriangle{ { 0, 1, 2 } };
const MeshElements OneQuad{ { 0, 1, 2, 3 } };
const MeshElements AlongFirst{ { 0, 1, 2 }, { 0, 2, 3 } };
const MeshElements AlongSecond{ { 0, 1, 3 }, { 1, 2, 3 } };

using Vector = std::array<double, 3>;
using Corners = std::array<Vector, 4>;

Corners
GetCorners(MeshReader & reader, const MeshFace & face)
{
  Corners corners;
  for (size_t corner = 0; corner < corners.size(); ++corner)
  {
    const auto & position = reader.GetVertex(face.vertices[corner]).position;
    std::copy(position.begin(), position.end(), corners[corner].begin());
  }
  return corners;
}

/** Twice the area of a triangle as seen along the normal; below zero when it is turned over. */
double
GetArea(const Corners & corners, size_t a, size_t b, size_t c, const Vector & normal)
{
  return itk::MedialVoxelDot(itk::MedialVoxelCross(itk::MedialVoxelSubtract(corners[b], corners[a]),
                                                   itk::MedialVoxelSubtract(corners[c], corners[a])),
                             normal);
}

/** Whether each corner of the quad turns to the left by enough. */
bool
IsGoodQuad(const Corners & corners, const Vector & normal)
{
  const double length = itk::MedialVoxelNorm(normal);
  for (size_t corner = 0; corner < 4; ++corner)
  {
    const Vector next = itk::MedialVoxelSubtract(corners[(corner + 1) % 4], corners[corner]);
    const Vector last = itk::MedialVoxelSubtract(corners[(corner + 3) % 4], corners[corner]);
    const double limit = SmallestSine * itk::MedialVoxelNorm(next) * itk::MedialVoxelNorm(last) * length;
    if (!(itk::MedialVoxelDot(itk::MedialVoxelCross(next, last), normal) > limit))
    {
      return false;
    }
  }
  return true;
}

} // namespace

const MeshElements &
GetTriangles(MeshReader & reader, const MeshFace & face)
{
  if (face.numberOfVertices == 3)
  {
    return OneTriangle;
  }
  const Corners corners = GetCorners(reader, face);
  const Vector  first = itk::MedialVoxelSubtract(corners[2], corners[0]);
  const Vector  second = itk::MedialVoxelSubtract(corners[3], corners[1]);
  return itk::MedialVoxelDot(second, second) < itk::MedialVoxelDot(first, first) ? AlongSecond : AlongFirst;
}

std::uint8_t
GetElementSides(const MeshFace & face, const MeshCorners & corners, const std::uint8_t sidesOfFace)
{
  unsigned int sides = 0;
  for (size_t k = 0; k < corners.size(); ++k)
  {
    const unsigned int corner = corners[k];
    const bool         isSide = (corner + 1) % face.numberOfVertices == corners[(k + 1) % corners.size()];
    sides |= isSide ? (sidesOfFace >> corner & 1U) << k : 0U;
  }
  return static_cast<std::uint8_t>(sides);
}

const MeshElements &
GetElements(MeshReader & reader, const MeshFace & face)
{
  if (face.numberOfVertices == 3)
  {
    return OneTriangle;
  }
  const Corners corners = GetCorners(reader, face);
  const Vector  normal = itk::MedialVoxelCross(itk::MedialVoxelSubtract(corners[2], corners[0]),
                                              itk::MedialVoxelSubtract(corners[3], corners[1]));
  if (IsGoodQuad(corners, normal))
  {
    return OneQuad;
  }
  const double first = std::min(GetArea(corners, 0, 1, 2, normal), GetArea(corners, 0, 2, 3, normal));
  const double second = std::min(GetArea(corners, 0, 1, 3, normal), GetArea(corners, 1, 2, 3, normal));
  return second > first ? AlongSecond : AlongFirst;
}

} // end namespace medialvoxel
