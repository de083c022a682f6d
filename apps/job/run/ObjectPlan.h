// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectPlan_h
#define medialvoxelObjectPlan_h

#include "InputVolume.h"
#include "Options.h"
#include "Text.h"

namespace medialvoxel
{

/** The plan of an extraction of all objects of a label map, as names and values to print: objects, passes, reads,
 * memory. Reads all voxels once, and unpacks none to memory.
 * \throw JobError CorruptInput when the values are no label map; Usage when all are 0; Refused when memory is short */
TextTable
DescribeObjects(const JobOptions & options, const VolumeHeader & header, const ReadObserver & observer);

} // end namespace medialvoxel

#endif
