// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelElementQuality_h
#define itkMedialVoxelElementQuality_h

#include "itkMedialVoxelVector3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** Twice the area of a triangle, along its normal. */
inline MedialVoxelVector3
MedialVoxelTriangleNormal(const std::array<MedialVoxelVector3, 3> & corners)
{
  return MedialVoxelCross(MedialVoxelSubtract(corners[1], corners[0]), MedialVoxelSubtract(corners[2], corners[0]));
}

/** The scaled Jacobian of the Verdict library: 1 for an equilateral triangle, 0 for a flat one. */
double
MedialVoxelScaledJacobian(const std::array<MedialVoxelVector3, 3> & corners);

/** The same for a quadrilateral: 1 for a rectangle, below 0 where a corner is turned in. Corners go round it. */
double
MedialVoxelScaledJacobian(const std::array<MedialVoxelVector3, 4> & corners);

/** The aspect ratio of the Verdict library: 1 for an equilateral triangle, infinite for a flat one. */
double
MedialVoxelAspectRatio(const std::array<MedialVoxelVector3, 3> & corners);

/** The same for a quadrilateral: 1 for a square. */
double
MedialVoxelAspectRatio(const std::array<MedialVoxelVector3, 4> & corners);

/** The angle between the halves of a quadrilateral, in degrees, along the diagonal where it is larger. */
double
MedialVoxelWarpage(const std::array<MedialVoxelVector3, 4> & corners);

/** How good an element of a shell model is: its scaled Jacobian. */
double
MedialVoxelShellQuality(const std::array<MedialVoxelVector3, 3> & corners);

/** The same for a quadrilateral: the least of the scaled Jacobian, 1.3 over the aspect ratio, and the flatness, which
 * is 1 where the normals at all corners are the same, 0.8 for cosines of 0.9 between them, and 0.4 for 0.7. */
double
MedialVoxelShellQuality(const std::array<MedialVoxelVector3, 4> & corners);

/** Shapes of all elements of a mesh; of none, all are as of a square. */
struct MedialVoxelShapeSummary
{
  std::uint64_t notPositive{ 0 };   ///< elements whose scaled Jacobian is not above 0
  double        leastJacobian{ 1 }; ///< scaled Jacobian, of all elements
  double        lowJacobian{ 1 };   ///< that 99 % reach
  double        highAspect{ 1 };    ///< aspect ratio that 99 % do not exceed
  double        largestAspect{ 1 };
  double        highWarpage{ 0 }; ///< degrees, that 99 % of the quadrilaterals do not exceed
  double        largestWarpage{ 0 };
  double        leastAngle{ 90 }; ///< degrees, at corners of elements
  double        largestAngle{ 90 };
  double        shortestSide{ 0 }; ///< length, in the units of the points
  double        meanSide{ 0 };     ///< over the elements
  double        longestSide{ 0 };
};

/** \class MedialVoxelElementShapes
 * \brief Collects the shapes of elements.
 * \ingroup MedialVoxel
 */
class MedialVoxelElementShapes
{
public:
  /** \param points of the mesh \param corners places of its corners \param number of them, 3 or 4 */
  void
  Add(const std::vector<MedialVoxelVector3> & points,
      const std::array<std::uint32_t, 4> &    corners,
      unsigned int                            number);

  MedialVoxelShapeSummary
  Summarize() const;

private:
  template <std::size_t VCorners>
  void
  AddShape(const std::array<MedialVoxelVector3, VCorners> & corners);

  std::vector<double> m_Jacobians;
  std::vector<double> m_Aspects;
  std::vector<double> m_Warpages; ///< of quadrilaterals
  std::vector<double> m_Cosines;  ///< of the angles of corners
  std::vector<double> m_Lengths;  ///< of sides, for each element again
};

/** The value that a share of all does not exceed; \a values are not empty, and change their order. */
double
MedialVoxelFindPercentile(std::vector<double> & values, double share);

} // end namespace itk

#endif
