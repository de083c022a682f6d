// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLoneTriangles_h
#define itkMedialVoxelLoneTriangles_h

#include "itkMedialVoxelShellElements.h"

#include <vector>

namespace itk
{

/** Takes triangles away that are apart from each other: one of them goes through quadrilaterals until it meets another.
 *
 * A triangle and a quadrilateral beside it are five corners, which can be divided in five ways, each with the triangle
 * at another corner. Nothing but the sides inside these five corners changes. Two triangles that meet become a
 * quadrilateral. If that is bad, their side becomes a point, and both are gone. At a rim, the side there becomes a
 * point, where that leaves the rim near to where it was. What is nearest is done, by the number of quadrilaterals
 * between.
 * \param complex      has the points; vertices that become one do so here, too
 * \param fine         the middles of elements stay near to it where vertices become one
 * \param leastQuality of all elements that change
 * \param elements     those that are gone are taken out */
void
MedialVoxelJoinLoneTriangles(MedialVoxelTriangleComplex &           complex,
                             const MedialVoxelFineSheet &           fine,
                             double                                 leastQuality,
                             std::vector<MedialVoxelShellElement> & elements);

} // end namespace itk

#endif
