// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTerminal_h
#define medialvoxelTerminal_h

namespace medialvoxel
{

/** Lets the standard streams pass bytes as they are, and a terminal show UTF-8. */
void
PrepareStreams();

/** True when the error stream is a terminal that a line can be drawn over in. */
bool
CanDrawOverLines();

/** Columns of the terminal, 80 where it does not tell. */
int
GetTerminalColumns();

} // end namespace medialvoxel

#endif
