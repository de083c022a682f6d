// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceFit.h"

#include <algorithm>

namespace itk
{

void
MedialVoxelSurfaceFit::AddTangents(const Tangent & a, const Tangent & b)
{
  const PointType between{ { a.normal[0] - b.normal[0], a.normal[1] - b.normal[1], a.normal[2] - b.normal[2] } };
  const double    length = MedialVoxelNorm(between);
  const PointType normal{ { between[0] / length, between[1] / length, between[2] / length } };
  const double    distance = (MedialVoxelDot(a.normal, a.point) - MedialVoxelDot(b.normal, b.point)) / length;
  PointType       middle{
          { 0.5 * (a.point[0] + b.point[0]), 0.5 * (a.point[1] + b.point[1]), 0.5 * (a.point[2] + b.point[2]) }
  };
  const double toPlane = distance - MedialVoxelDot(normal, middle);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    middle[axis] += toPlane * normal[axis];
  }
  this->AddPlane(normal, middle);
}

auto
MedialVoxelSurfaceFit::GetPoint(const double pull, const PointType & reach) const -> PointType
{
  // Positive definite, as the pull is positive: the inverse by cofactors exists.
  const double xx = m_Matrix[0] + pull;
  const double xy = m_Matrix[1];
  const double xz = m_Matrix[2];
  const double yy = m_Matrix[3] + pull;
  const double yz = m_Matrix[4];
  const double zz = m_Matrix[5] + pull;

  const PointType firstRow{ { yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy } };
  const PointType secondRow{ { firstRow[1], xx * zz - xz * xz, xy * xz - xx * yz } };
  const PointType thirdRow{ { firstRow[2], secondRow[2], xx * yy - xy * xy } };
  const double    determinant = MedialVoxelDot({ { xx, xy, xz } }, firstRow);

  PointType point{
    { MedialVoxelDot(firstRow, m_Vector), MedialVoxelDot(secondRow, m_Vector), MedialVoxelDot(thirdRow, m_Vector) }
  };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    point[axis] = std::clamp(point[axis] / determinant, -reach[axis], reach[axis]);
  }
  return point;
}

MedialVoxelSurfaceFit::Plane
MedialVoxelSurfaceFit::GetPlane() const
{
  Plane plane;
  plane.normal = Normalized(m_SumOfNormals, plane.normal);
  plane.distance = MedialVoxelDot(plane.normal, m_SumOfPoints) / m_NumberOfPlanes;
  return plane;
}

} // end namespace itk
