// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelResolutionBand_h
#define itkMedialVoxelResolutionBand_h

namespace itk
{

/** Relative width of the band around a threshold in which sums of rounded edge lengths decide nothing; such sums err by
 * far less. All searches for paths use this one: what one leaves undecided, another resolves exactly. */
constexpr double MedialVoxelResolutionBand = 1e-9;

} // end namespace itk

#endif
