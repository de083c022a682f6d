// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProgram_h
#define medialvoxelProgram_h

#include <functional>
#include <string>

namespace medialvoxel
{

/** The frame of main(): catches signals, calls the body, and prints an error as a line that begins with the program's
 * name. Results that the body could not write to the standard output are an error too.
 * \return the exit status of the process: from the body, or from its error */
int
RunProgram(const std::string & name, const std::function<int()> & body);

} // end namespace medialvoxel

#endif
