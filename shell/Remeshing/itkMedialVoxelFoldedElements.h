// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFoldedElements_h
#define itkMedialVoxelFoldedElements_h

#include "itkMedialVoxelRemeshedSheet.h"

namespace itk
{

/** Whether a quadrilateral folds when a solver gives it its thickness: whether the brick between its corners, half the
 * thickness off to both sides along the normals there, has no positive Jacobian at one of its 2 x 2 x 2 Gauss points.
 * CalculiX makes bricks of shell elements and refuses these. \pre corners go round it */
bool
MedialVoxelIsFolded(const std::array<MedialVoxelVector3, 4> & corners, double thickness);

/** Splits quadrilaterals that fold, or would with half as much thickness again, into two triangles along the better
 * diagonal: solvers also take the mean of normals with the elements beside them. Triangles are flat. */
void
MedialVoxelSplitFolded(MedialVoxelRemeshedSheet & sheet);

} // end namespace itk

#endif
