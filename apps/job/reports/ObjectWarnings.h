// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectWarnings_h
#define medialvoxelObjectWarnings_h

#include "Warning.h"

#include <string>
#include <vector>

namespace medialvoxel
{

struct JobOptions;
struct JobResult;

/** Warns of the object of a run by its counts.
 * \throw JobError Usage for a label that no voxel has: a mistake, no empty object */
void
ApplyObjectRules(std::vector<Warning> & warnings, const JobOptions & options, const JobResult & result);

/** The codes of these warnings. */
void
AddObjectCodes(std::vector<std::string> & codes);

} // end namespace medialvoxel

#endif
