// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceFit_h
#define itkMedialVoxelSurfaceFit_h

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
  AddPair(const PointType & a, const PointType & b);

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
  void
  AddPlane(const PointType & normal, const PointType & point);

  /** Sums of n n^T (xx, xy, xz, yy, yz, zz) and n (n m) for the unit normals n and the points m of the planes. */
  std::array<double, 6> m_Matrix{};
  PointType             m_Vector{};

  PointType m_SumOfNormals{};
  PointType m_SumOfPoints{};
  double    m_NumberOfPlanes{ 0.0 };
};

} // end namespace itk

#endif
