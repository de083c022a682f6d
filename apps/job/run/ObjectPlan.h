// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectPlan_h
#define medialvoxelObjectPlan_h

#include "InputVolume.h"
#include "Options.h"
#include "Text.h"

namespace medialvoxel
{

/** What an extraction of all objects of a label map will do, as names and values to print: objects, passes, how it
 * reads, memory. Reads all voxels once, and unpacks none to memory.
 * \throw JobError CorruptInput for values that are not those of a label map; Usage when all are 0; Refused when there
 * is not enough memory */
TextTable
DescribeObjects(const JobOptions & options, const VolumeHeader & header, const ReadObserver & observer);

} // end namespace medialvoxel

#endif
