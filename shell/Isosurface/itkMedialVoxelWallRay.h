// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallRay_h
#define itkMedialVoxelWallRay_h

#include "itkMedialVoxelMargins.h"

#include <array>
#include <cstdint>
#include <optional>

namespace itk
{

/** What ends a ray.
 * \ingroup MedialVoxel */
enum class MedialVoxelRayEnd : std::uint8_t
{
  Surface, ///< the opposite one: the length is known
  Image,   ///< or the ray starts outside of it
  Maximum, ///< the ray is longer
  Unknown  ///< no gradient, no object within a voxel, or margins that are not known
};

/** \struct MedialVoxelRayResult
 * \brief End and length of a ray.
 * \ingroup MedialVoxel
 */
struct MedialVoxelRayResult
{
  MedialVoxelRayEnd end;
  double            length{ 0.0 }; ///< to the opposite surface, in the units of the spacing
};

/** \class MedialVoxelWallRay
 * \brief Length of a ray from a point of the surface through the object to the opposite surface.
 *
 * The ray has the direction of the gradient of the margins, smoothed with a standard deviation of one voxel. It goes in
 * steps of a quarter of the smallest spacing through margins that are linear between voxels, and ends where they first
 * become negative again; there the length is found to a millionth of a step.
 * \ingroup MedialVoxel
 */
class MedialVoxelWallRay
{
public:
  using Point = std::array<double, 3>;

  /** \param spacing of voxels \param maximum longest ray, positive, in the units of the spacing */
  MedialVoxelWallRay(const MedialVoxelMargins & margins, const MedialVoxelGrid::SpacingType & spacing, double maximum);

  /** \param start continuous index of a point of the surface */
  MedialVoxelRayResult
  Measure(const Point & start) const;

  /** Slices on both sides of a point whose margins are needed. */
  static std::int64_t
  GetHalo(double spacingOfSlices, double maximum);

private:
  /** Physical unit vector along the axes of the image; nothing where margins do not change. */
  std::optional<Point>
  FindDirection(const Point & start) const;

  /** False outside the image. */
  bool
  IsInImage(const Point & point) const;

  double
  Interpolate(const Point & point) const;

  const MedialVoxelMargins &   m_Margins;
  MedialVoxelGrid::SpacingType m_Spacing;
  double                       m_Maximum;
  double                       m_Step;
};

} // end namespace itk

#endif
