// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelScan_h
#define itkMedialVoxelScan_h

#include <optional>
#include <string>

namespace itk
{

/** \class MedialVoxelScan
 * \brief A model of the gray values of a scan: two materials, a blur and noise.
 *
 * Across a flat surface the mean values rise from \a background to \a material like the cumulative normal distribution
 * with the standard deviation \a blur.
 * \ingroup MedialVoxel
 */
struct MedialVoxelScan
{
  double background{ 0.0 };  ///< value of voxels without material
  double material{ 0.0 };    ///< value of voxels inside thick walls; may be the smaller one
  double blur{ 0.0 };        ///< in voxels, greater than 0; includes the blur of the voxel itself
  double noise{ 0.0 };       ///< standard deviation of a value, at least 0
  double correlation{ 1.0 }; ///< ratio of the variance of local means to the variance for independent values

  /** The noise of a value when the contrast of the materials is 1. */
  double
  GetRelativeNoise() const
  {
    const double contrast = material - background;
    return noise / (contrast < 0.0 ? -contrast : contrast);
  }
};

/** \struct MedialVoxelScanResult
 * \brief The scan, or why there is none.
 * \ingroup MedialVoxel
 */
struct MedialVoxelScanResult
{
  std::optional<MedialVoxelScan> scan{};
  std::string                    reason{};        ///< empty with a scan
  bool                           isMask{ false }; ///< or a label map, whose walls are measured on the object

  static MedialVoxelScanResult
  OfMask()
  {
    return { std::nullopt, "the values are those of a mask or a label map", true };
  }
};

} // end namespace itk

#endif
