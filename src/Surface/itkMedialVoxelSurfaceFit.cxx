// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceFit.h"

#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using PointType = MedialVoxelSurfaceFit::PointType;

/** \a vector scaled to length 1; \a otherwise when it has none. */
PointType
Normalized(const PointType & vector, const PointType & otherwise)
{
  const double length = MedialVoxelNorm(vector);
  return length > 0.0 ? PointType{ { vector[0] / length, vector[1] / length, vector[2] / length } } : otherwise;
}

} // namespace

void
MedialVoxelSurfaceFit::AddPair(const PointType & a, const PointType & b)
{
  const PointType normal = Normalized({ { b[0] - a[0], b[1] - a[1], b[2] - a[2] } }, { { 0.0, 0.0, 1.0 } });
  this->AddPlane(normal, { { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) } });
}

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

void
MedialVoxelSurfaceFit::AddPlane(const PointType & normal, const PointType & point)
{
  const double distance = MedialVoxelDot(normal, point);
  // The two sides of a wall have no order; the normal that is nearer to the sum so far does not cancel it.
  const double sign = MedialVoxelDot(normal, m_SumOfNormals) < 0.0 ? -1.0 : 1.0;
  unsigned int entry = 0;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = row; column < 3; ++column)
    {
      m_Matrix[entry++] += normal[row] * normal[column];
    }
    m_Vector[row] += normal[row] * distance;
    m_SumOfNormals[row] += sign * normal[row];
    m_SumOfPoints[row] += point[row];
  }
  m_NumberOfPlanes += 1.0;
}

PointType
MedialVoxelSurfaceFit::GetPoint(const double pull, const PointType & reach) const
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
