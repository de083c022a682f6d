// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProgram_h
#define medialvoxelProgram_h

#include <functional>
#include <string>

namespace medialvoxel
{

/** What main() does: catches signals, calls the body, and makes of an error a line on the error stream that begins with
 * the program's name, and an exit status. Results that the body left unwritten to the standard output are an error too.
 * \return the exit status of the process: the body's, or the one that its error calls for */
int
RunProgram(const std::string & name, const std::function<int()> & body);

} // end namespace medialvoxel

#endif
