// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrayBoundary_h
#define itkMedialVoxelGrayBoundary_h

#include "itkMedialVoxelGray.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelGrayBoundary
 * \brief Moves boundary points to where the gray values cross the threshold that keeps them out of the object.
 *
 * A point moves along the gradient of the values, taken half a voxel towards the wall; values between voxels are
 * trilinear. Outside the image, where nothing is known, the outermost voxels are continued.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrayBoundary
{
public:
  using PositionType = std::array<double, 3>;

  /** Voxels around a boundary point whose values are read. */
  static constexpr std::int64_t Reach = 3;

  /** \struct Crossing
   * \brief Where the values cross the threshold, in the units of the spacing from voxel 0.
   * \ingroup MedialVoxel
   */
  struct Crossing
  {
    PositionType position{ { 0.0, 0.0, 0.0 } };
    PositionType normal{ { 0.0, 0.0, 0.0 } }; ///< into the object, of length 1
    double       numberOfLines{ 0.0 };        ///< that found it, up to 4; 0: there is no crossing within two voxels
    bool         isRising{ true };            ///< into the object, through the lower threshold
  };

  /** Object are the voxels from \a lower to \a upper, of which one may be infinite. */
  MedialVoxelGrayBoundary(const MedialVoxelGrid & grid, double lower, double upper);

  /** The crossing next to a boundary point.
   *
   * \param gray     values of the voxels within Reach of the point that the image has
   * \param inwards  direction into the object, about, in the units of the spacing; not zero */
  Crossing
  Find(const MedialVoxelGray & gray, const MedialVoxelIndex & point, const PositionType & inwards) const;

  /** Position of a known surface along its normal, from voxel 0: the mean of 16 lines around a place. The error of a
   * line depends on its place between the voxels. Boundary points prefer some places; the mean does not.
   *
   * \param gray      values of the voxels of \a box that the image has
   * \param box       beyond which no value is read
   * \param place     about on the surface, in the units of the spacing from voxel 0
   * \param surface   its normal, of length 1, and the threshold
   * \param position  changed only when a line finds the surface
   * \return false when none does */
  bool
  FindAround(const MedialVoxelGray & gray,
             const MedialVoxelBox &  box,
             const PositionType &    place,
             const Crossing &        surface,
             double &                position) const;

private:
  /** Values relative to the threshold that separates a boundary point from the object. */
  struct Field;

  /** A vector of voxels along a physical direction, the largest component of which is 1. */
  PositionType
  ToVoxels(const PositionType & direction) const;

  void
  GetTangents(const PositionType & gradient, PositionType (&tangents)[2]) const;

  MedialVoxelGrid m_Grid;
  double          m_Lower;
  double          m_Upper;
};

} // end namespace itk

#endif
