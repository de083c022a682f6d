// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLoneTriangles_h
#define itkMedialVoxelLoneTriangles_h

#include "itkMedialVoxelShellElements.h"

#include <vector>

namespace itk
{

/** Joins triangles that are apart from each other: one of them goes through quadrilaterals until it meets another.
 *
 * A triangle and a quadrilateral beside it are five corners, which can be divided in five ways, each with the triangle
 * at another corner. Nothing but the sides inside these five corners changes. The nearest triangle is taken, by the
 * number of quadrilaterals between; all elements that change have a quality of 0.4 at least.
 * \param complex has the points
 * \param elements those that were joined are taken out */
void
MedialVoxelJoinLoneTriangles(const MedialVoxelTriangleComplex &     complex,
                             std::vector<MedialVoxelShellElement> & elements);

} // end namespace itk

#endif
