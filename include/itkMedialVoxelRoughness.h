// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRoughness_h
#define itkMedialVoxelRoughness_h

#include "itkMedialVoxelBits.h"

#include "MedialVoxelExport.h"

#include <cstdint>

namespace itk
{

/** \class MedialVoxelRoughness
 * \brief How much noise a mask has: the share of the voxels at its border that stand alone.
 *
 * A voxel at the border is not at a face of the image and has one of the other kind among its neighbors. It is rough
 * when all but at most one of its neighbors along the axes are of the other kind. Smooth masks have few rough voxels,
 * whatever their shape. Axes with one voxel do not count.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelRoughness
{
  std::uint64_t roughVoxels{ 0 };
  std::uint64_t borderVoxels{ 0 };

  /** From 0 to 1; 0 without a border. */
  double
  GetRatio() const
  {
    return borderVoxels == 0 ? 0.0 : static_cast<double>(roughVoxels) / static_cast<double>(borderVoxels);
  }

  /** True from 0.75 % on, which all masks with harmful noise have and clean ones do not. */
  bool
  NeedsSmoothing() const
  {
    return borderVoxels > 0 && 400 * roughVoxels >= 3 * borderVoxels;
  }

  MedialVoxelRoughness &
  operator+=(const MedialVoxelRoughness & other)
  {
    roughVoxels += other.roughVoxels;
    borderVoxels += other.borderVoxels;
    return *this;
  }
};

/** \brief Count the voxels of \a box. \a object has the bits of the image around it, one voxel farther on each side.
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT MedialVoxelRoughness
MedialVoxelMeasureRoughness(const MedialVoxelBits & object, const MedialVoxelBox & box, const MedialVoxelBox & image);

} // end namespace itk

#endif
