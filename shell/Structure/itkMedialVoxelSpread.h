// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSpread_h
#define itkMedialVoxelSpread_h

#include "itkMedialVoxelEigenvectors.h"
#include "itkMedialVoxelVector3.h"

#include <array>

namespace itk
{

/** \class MedialVoxelSpread
 * \brief How weighted points lie around their middle: sums of first and second order.
 * \ingroup MedialVoxel
 */
class MedialVoxelSpread
{
public:
  using Point = MedialVoxelVector3;

  /** Of points beside \a origin, for the precision. */
  explicit MedialVoxelSpread(const Point & origin = {})
    : m_Origin(origin)
  {}

  void
  Add(const Point & point, double weight);

  double
  GetWeight() const
  {
    return m_Weight;
  }

  Point
  GetMiddle() const;

  /** Whether the points leave no plane by more than \a distance, as the root of their mean square. */
  bool
  IsWithin(double distance) const;

  /** Variances along three axes, the smallest first, and these axes, of length 1. */
  struct Axes
  {
    std::array<double, 3> variances;
    std::array<Point, 3>  directions;
  };
  Axes
  FindAxes() const;

private:
  MedialVoxelMatrix3
  GetCovariance() const;

  Point              m_Origin;
  double             m_Weight{ 0 };
  Point              m_Sum{};
  MedialVoxelMatrix3 m_Squares{};
};

} // end namespace itk

#endif
