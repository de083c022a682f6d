// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWarnings_h
#define medialvoxelWarnings_h

#include "Warning.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace medialvoxel
{

class ProgressSink;
class Survey;
struct DistanceOptions;
struct ExtractOptions;
struct JobResult;
struct PartOptions;
struct VolumeHeader;

/** Warnings of the options and the header, before the run. The tables of Warnings.cxx and ObjectWarnings.cxx have a
 * row for each code. */
std::vector<Warning>
FindWarningsOfRequest(const ExtractOptions & options, const VolumeHeader & input);
std::vector<Warning>
FindWarningsOfRequest(const DistanceOptions & options, const VolumeHeader & input);

std::vector<Warning>
FindWarningsOfRequest(const PartOptions & options, const VolumeHeader & input);

/** Warnings of the counts and the thickness, after the run. */
std::vector<Warning>
FindWarningsOfResult(const ExtractOptions & options, const JobResult & result, const Survey & survey);

/** The same of a run that does not survey its walls. */
std::vector<Warning>
FindWarningsOfResult(const ExtractOptions & options, const JobResult & result);
std::vector<Warning>
FindWarningsOfResult(const DistanceOptions & options, const JobResult & result);
std::vector<Warning>
FindWarningsOfResult(const PartOptions & options, const JobResult & result);

/** The codes of all warnings of reports, each once. */
std::set<std::string>
ListWarningCodes();

/** The sink hears of the warnings from number \a first on. */
void
TellWarnings(ProgressSink & sink, const std::vector<Warning> & warnings, std::size_t first = 0);

} // end namespace medialvoxel

#endif
