// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelResolutionBand_h
#define itkMedialVoxelResolutionBand_h

namespace itk
{

/** Relative width of the band around a threshold in which sums of rounded edge lengths decide nothing; their error is
 * far smaller. All path searches share it: an exact search resolves cases in the band. */
constexpr double MedialVoxelResolutionBand = 1e-9;

} // end namespace itk

#endif
