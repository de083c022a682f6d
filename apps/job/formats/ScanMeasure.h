// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelScanMeasure_h
#define medialvoxelScanMeasure_h

#include "InputVolume.h"

namespace medialvoxel
{

/** Finds out from a prepared volume how its walls are measured on gray values. Where that is not asked for and walls
 * cannot be fitted, they are measured on the object.
 * \throw JobError Refused when an uncertainty is wanted but cannot be stated; what the observer throws, and
 * InputVolume::Fill() */
WallMeasure
FindWallMeasure(InputVolume &          input,
                const VolumeHeader &   header,
                const ExtractOptions & options,
                const ReadObserver &   observer);

} // end namespace medialvoxel

#endif
