// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionChecks_h
#define medialvoxelOptionChecks_h

#include "Options.h"

namespace medialvoxel
{

/** \throw JobError Usage when a value is out of its range or options contradict each other. */
void
CheckOptions(const ExtractOptions & options);
void
CheckOptions(const DistanceOptions & options);
void
CheckOptions(const PartOptions & options);
void
CheckOptions(const JobOptions & options);
void
CheckOptions(const RawDescription & raw);

} // end namespace medialvoxel

#endif
