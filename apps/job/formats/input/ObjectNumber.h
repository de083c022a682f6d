// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectNumber_h
#define medialvoxelObjectNumber_h

#include "itkMedialVoxelLabelTable.h"

namespace medialvoxel
{

using ObjectNumber = itk::MedialVoxelObjectNumber;

} // end namespace medialvoxel

#endif
