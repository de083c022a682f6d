// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPhaseTable_h
#define medialvoxelPhaseTable_h

#include "JobCommands.h"

#include <ostream>

namespace medialvoxel
{

/** Names and values in two columns. */
void
PrintTable(std::ostream & out, const TextTable & table);

/** What Table 1 of the paper tells about a volume: resolution, tau, seconds, and the percentage that each phase
 * decided. */
void
PrintPhaseTable(std::ostream & out, const ExtractOptions & options, const JobResult & result);

/** The same of a job, or that it was finished before. */
void
PrintFinalization(std::ostream & out, const FinalizeResult & result);

/** The like for the surface of a part. */
void
PrintSurfaceTable(std::ostream & out, const PartOptions & options, const JobResult & result);

/** The like for distances. */
void
PrintDistanceTable(std::ostream & out, const DistanceOptions & options, const JobResult & result);

} // end namespace medialvoxel

#endif
