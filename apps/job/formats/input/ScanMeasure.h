// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelScanMeasure_h
#define medialvoxelScanMeasure_h

#include "InputVolume.h"

namespace medialvoxel
{

/** Chooses from a prepared volume how all walls of a run are measured: on gray values where a threshold cuts them, by
 * fits where walls can be fitted, else where the values cross the threshold; masks and label maps on the object.
 * \param threads that the memory has room for
 * \throw JobError Refused when an uncertainty is wanted but cannot be stated; errors of the observer and of
 * InputVolume::Fill() */
WallMeasure
FindWallMeasure(InputVolume &          input,
                const VolumeHeader &   header,
                const ExtractOptions & options,
                unsigned int           threads,
                const ReadObserver &   observer);

/** The gray values that walls are measured on, or nothing: then it is the object. */
std::optional<itk::MedialVoxelSheetExtraction::GrayRange>
GetGrayRange(const WallMeasure & measure, const JobOptions & options, const VolumeHeader & header);

} // end namespace medialvoxel

#endif
