// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNrrdHeaderPrivate_h
#define itkMedialVoxelNrrdHeaderPrivate_h

#include "itkMedialVoxelNrrdHeader.h"

namespace itk
{

/** Fills in spacing, origin, direction, space and measurement frame from the fields and sizes of a header. */
void
ReadMedialVoxelNrrdGeometry(MedialVoxelNrrdHeader & header);

} // end namespace itk

#endif
