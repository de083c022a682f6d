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
struct ValueStatistics;

/** Warns before a run without thresholds of values that are no mask. */
void
ApplyValueRules(std::vector<Warning> & warnings, const ValueStatistics & values);

/** Warns of the object of a run by its counts.
 * \throw JobError Usage for a label that no voxel has: a mistake, no empty object */
void
ApplyObjectRules(std::vector<Warning> & warnings, const JobOptions & options, const JobResult & result);

/** The codes of these warnings. */
void
AddObjectCodes(std::vector<std::string> & codes);

} // end namespace medialvoxel

#endif
