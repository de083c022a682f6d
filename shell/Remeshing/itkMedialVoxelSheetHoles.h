// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetHoles_h
#define itkMedialVoxelSheetHoles_h

#include "itkMedialVoxelSheet.h"

namespace itk
{

/** Closes holes that are narrower than the wall is thick, or than an element: the sheet of a wall ends half its
 * thickness before a hole, so that these are none of the part.
 * \param least the least size of elements
 * \return how many there were */
std::uint64_t
MedialVoxelCloseHoles(MedialVoxelSheet & sheet, double least);

} // end namespace itk

#endif
