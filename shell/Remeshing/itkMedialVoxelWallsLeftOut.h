// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallsLeftOut_h
#define itkMedialVoxelWallsLeftOut_h

#include "itkMedialVoxelSheet.h"
#include "itkMedialVoxelVector3.h"

#include <vector>

namespace itk
{

/** A wall that no element is left of. Lengths are in the units of the points. */
struct MedialVoxelWallLeftOut
{
  MedialVoxelVector3 place{}; ///< the middle of its triangles, by area
  double             area{ 0 };
  double             width{ 0 };       ///< twice the area over the length of its outline: that of a long strip
  double             elementSize{ 0 }; ///< that its elements would have had, at junctions
};

/** Those of a sheet that are not kept, the largest first.
 * \param wallOf the wall of each triangle
 * \param isKept of each wall
 * \param least  size of elements; it is the thickness of the wall where that is larger */
std::vector<MedialVoxelWallLeftOut>
MedialVoxelListWallsLeftOut(const MedialVoxelSheet &                     sheet,
                            const std::vector<MedialVoxelSheet::Index> & wallOf,
                            const std::vector<bool> &                    isKept,
                            double                                       least);

/** Adds walls to a list, the largest first. */
void
MedialVoxelAddWallsLeftOut(const std::vector<MedialVoxelWallLeftOut> & further,
                           std::vector<MedialVoxelWallLeftOut> &       walls);

} // end namespace itk

#endif
