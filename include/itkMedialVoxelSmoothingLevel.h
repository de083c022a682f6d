// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSmoothingLevel_h
#define itkMedialVoxelSmoothingLevel_h

#include <optional>

namespace itk
{

/** \struct MedialVoxelSmoothingLevel
 * \brief The value that smoothed values are compared with; nothing: the mask is smoothed and compared with one half.
 *
 * It follows from the voxels, however thresholds describe the object. Values are smoothed where all finite values of
 * the object are above those of the background, or all below, and each side has two values or more. The level is the
 * middle between the two nearest values of both sides.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSmoothingLevel
{
  std::optional<double> value{};
  bool                  objectIsAbove{ true };
};

} // end namespace itk

#endif
