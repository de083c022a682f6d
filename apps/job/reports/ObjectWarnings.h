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

/** Adds what the counts tell of the object of a run.
 * \throw JobError Usage for a label that no voxel has, which is no empty object but a mistake */
void
ApplyObjectRules(std::vector<Warning> & warnings, const JobOptions & options, const JobResult & result);

/** The codes of these warnings. */
void
AddObjectCodes(std::vector<std::string> & codes);

} // end namespace medialvoxel

#endif
