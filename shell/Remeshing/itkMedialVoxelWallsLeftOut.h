// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallsLeftOut_h
#define itkMedialVoxelWallsLeftOut_h

#include "itkMedialVoxelFineSheet.h"

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

/** Those of the fine sheet that are not kept, the largest first.
 * \param isKept of each wall
 * \param least  size of elements; it is the thickness of the wall where that is larger */
std::vector<MedialVoxelWallLeftOut>
MedialVoxelListWallsLeftOut(const MedialVoxelFineSheet & fine, const std::vector<bool> & isKept, double least);

} // end namespace itk

#endif
