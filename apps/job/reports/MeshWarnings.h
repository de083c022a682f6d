// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshWarnings_h
#define medialvoxelMeshWarnings_h

#include "Warning.h"

#include <string>
#include <vector>

namespace medialvoxel
{

struct JobResult;

/** Warns of a mesh whose elements lack a part of the sheet, or that solvers refuse. */
void
ApplyMeshRules(std::vector<Warning> & warnings, const JobResult & result);

/** The codes of these warnings. */
void
AddMeshCodes(std::vector<std::string> & codes);

} // end namespace medialvoxel

#endif
