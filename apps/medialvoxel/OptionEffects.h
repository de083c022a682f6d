// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionEffects_h
#define medialvoxelOptionEffects_h

#include "CommandLine.h"

namespace medialvoxel
{

/** Refuses options that can change nothing beside the others. What only the volume decides is a warning of the job.
 * \throw JobError Usage that names the option and what it needs */
void
CheckOptionEffects(const CommandLine & line);

} // end namespace medialvoxel

#endif
