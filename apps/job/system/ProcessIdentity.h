// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProcessIdentity_h
#define medialvoxelProcessIdentity_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace medialvoxel
{

/** \class ProcessIdentity
 * \brief Distinguishes a process from all others that ever wrote to a folder, on any machine. */
struct ProcessIdentity
{
  std::string   host;           ///< 12 hexadecimal digits of a machine since it was started, and of a container on it
  int           number{ 0 };    ///< which another process has later
  std::uint64_t startTime{ 0 }; ///< in ticks of the system, which differ between processes that have one number
};

/** The identity of this process; its host is empty where the system does not report it, as in a container without
 * /proc. */
const ProcessIdentity &
GetThisProcess();

/** Whether a process has ended; false whenever this cannot be known, as of a process of another machine. */
bool
HasEnded(const ProcessIdentity & process);

/** The name of this machine, for people. */
std::string
GetHostName();

/** The file of the program that this process runs; empty where the system does not tell. */
std::filesystem::path
GetProgramFile();

} // end namespace medialvoxel

#endif
