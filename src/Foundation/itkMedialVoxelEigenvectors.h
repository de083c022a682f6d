// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelEigenvectors_h
#define itkMedialVoxelEigenvectors_h

#include "MedialVoxelExport.h"

#include <array>

namespace itk
{

using MedialVoxelMatrix3 = std::array<std::array<double, 3>, 3>;

/** The eigenvectors of a symmetric matrix, one a row, by rotations of Jacobi in a fixed order.
 * \param matrix     gets the eigenvalues on its diagonal, in the order of the vectors
 * \param negligible values beside the diagonal below it count as 0 */
MedialVoxel_EXPORT MedialVoxelMatrix3
MedialVoxelFindEigenvectors(MedialVoxelMatrix3 & matrix, double negligible);

} // end namespace itk

#endif
