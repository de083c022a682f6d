// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSignals_h
#define medialvoxelSignals_h

namespace medialvoxel
{

/** Remembers SIGINT, SIGTERM and SIGHUP instead of dying from them; a SIGHUP that is ignored stays so. Writing to
 * a closed pipe or over a limit of the file size becomes an error of the write. */
void
CatchSignals();

/** The signal that asked to stop, or 0. */
int
GetStopSignal();

} // end namespace medialvoxel

#endif
