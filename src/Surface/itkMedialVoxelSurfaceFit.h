// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceFit_h
#define itkMedialVoxelSurfaceFit_h

#include "itkMedialVoxelVector3.h"

#include "MedialVoxelExport.h"

#include <array>

namespace itk
{

/** \class MedialVoxelSurfaceFit
 * \brief The point of a cell that lies best on the planes midway between pairs of boundary points.
 *
 * Coordinates are relative to the center of the cell. The point minimizes the squared distances to all planes and,
 * weighted little, to the center, which keeps neighbors apart whose planes are the same.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceFit
{
public:
  using PointType = std::array<double, 3>;

  /** Count in the plane midway between \a a and \a b, which differ. */
  void
  AddPair(const PointType & a, const PointType & b)
  {
    const PointType normal = Normalized(MedialVoxelSubtract(b, a), { { 0.0, 0.0, 1.0 } });
    this->AddPlane(normal, { { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) } });
  }

  /** A point of a wall and its normal, of length 1. */
  struct Tangent
  {
    PointType point;
    PointType normal;
  };

  /** Count in the plane as far from the tangent plane at \a a as from that at \a b. Normals point into the wall from
   * both of its sides, and differ. */
  void
  AddTangents(const Tangent & a, const Tangent & b);

  /** The best point, within \a reach of the center along each axis.
   *
   * \param pull  weight of the center, positive; 1 is that of a plane */
  PointType
  GetPoint(double pull, const PointType & reach) const;

  /** The plane of the mean direction and the mean middle of the pairs: unit normal, and its distance along it from the
   * center. */
  struct Plane
  {
    PointType normal{ { 0.0, 0.0, 1.0 } };
    double    distance{ 0.0 };
  };

  /** Meaningful after the first AddPair(). */
  Plane
  GetPlane() const;

private:
  /** \a vector scaled to length 1; \a otherwise when it has none. */
  static PointType
  Normalized(const PointType & vector, const PointType & otherwise)
  {
    const double length = MedialVoxelNorm(vector);
    return length > 0.0 ? PointType{ { vector[0] / length, vector[1] / length, vector[2] / length } } : otherwise;
  }

  // Here, so that the sums stay in registers from pair to pair.
  void
  AddPlane(const PointType & normal, const PointType & point)
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

  /** Sums of n n^T (xx, xy, xz, yy, yz, zz) and n (n m) for the unit normals n and the points m of the planes. */
  std::array<double, 6> m_Matrix{};
  PointType             m_Vector{};

  PointType m_SumOfNormals{};
  PointType m_SumOfPoints{};
  double    m_NumberOfPlanes{ 0.0 };
};

} // end namespace itk

#endif
