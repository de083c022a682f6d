// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelElementSmoothing_h
#define itkMedialVoxelElementSmoothing_h

#include "itkMedialVoxelFineSheet.h"
#include "itkMedialVoxelShellElements.h"

#include <vector>

namespace itk
{

/** Moves vertices inside walls to where the worst of their elements is better; those of rims and junctions stay.
 *
 * Vertices move on the fine sheet, and the middles of their elements stay within 0.08 of the size of it, or as
 * near as they were. No element falls below 0.45 that was above.
 * \param complex its vertices move
 * \param wanted   quadrilaterals that are none yet, as they are not good enough; they become better with the others
 * \param runTasks does vertices of parts, which are the same for any order */
void
MedialVoxelSmoothElements(MedialVoxelTriangleComplex &                 complex,
                          const MedialVoxelFineSheet &                 fine,
                          const std::vector<MedialVoxelShellElement> & elements,
                          const std::vector<MedialVoxelShellElement> & wanted,
                          const MedialVoxelRunTasks &                  runTasks);

} // end namespace itk

#endif
