// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelThickWalls_h
#define medialvoxelThickWalls_h

#include "JobPlan.h"
#include "Options.h"
#include "Progress.h"
#include "VolumeHeader.h"

namespace medialvoxel
{

/** Raises the maximum of the automatic thickness, up to 64 voxels, where its default is too small: a coarse look at the
 * object finds a fifth or more of its volume in thicker walls. It depends on the voxels alone. Options that give the
 * thickness, its maximum or labels stay.
 * \param options with the threshold of Otsu
 * \throw StoppedBySignal when the sink asks to stop; what reading throws */
void
RaiseMaximumThickness(ExtractOptions &     options,
                      const VolumeHeader & header,
                      const JobPlan &      plan,
                      const ProgressSink & sink);

} // end namespace medialvoxel

#endif
