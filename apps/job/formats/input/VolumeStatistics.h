// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVolumeStatistics_h
#define medialvoxelVolumeStatistics_h

#include "Progress.h"
#include "ValueStatistics.h"
#include "VolumeHeader.h"

namespace medialvoxel
{

/** Statistics of the stored values. \throw JobError as reading; errors of the observer */
ValueStatistics
MeasureValues(const VolumeHeader & header, const ReadObserver & observer);

/** The same of slices in the middle, which takes no time. */
ValueStatistics
MeasureSomeValues(const VolumeHeader & header);

/** Sets the lower threshold if it is to be measured and is not set.
 * \throw JobError Refused when all values are the same; Usage when the upper threshold is below
 * \throw StoppedBySignal when the sink asks to stop */
void
MeasureThreshold(JobOptions & options, const VolumeHeader & header, const ProgressSink & sink);

} // end namespace medialvoxel

#endif
