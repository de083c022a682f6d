// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWarnings_h
#define medialvoxelWarnings_h

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

class ProgressSink;
class Survey;
struct DistanceOptions;
struct ExtractOptions;
struct JobResult;
struct VolumeHeader;

/** What a user must know before a result is used. The job itself goes on, and its exit status does not change. */
struct Warning
{
  std::string                                 code;    ///< for scripts: small letters, words joined by underscores
  std::string                                 message; ///< for readers: one line without a period at its end
  std::vector<std::pair<std::string, double>> values;  ///< the numbers of the message by their names, all finite
};

/** What the options and the header tell before the run. The tables of Warnings.cxx have a row for each code. */
std::vector<Warning>
FindWarningsOfRequest(const ExtractOptions & options, const VolumeHeader & input);
std::vector<Warning>
FindWarningsOfRequest(const DistanceOptions & options, const VolumeHeader & input);

/** What the counts and the thickness tell after the run. */
std::vector<Warning>
FindWarningsOfResult(const ExtractOptions & options, const JobResult & result, const Survey & survey);
std::vector<Warning>
FindWarningsOfResult(const DistanceOptions & options, const JobResult & result);

/** The sink hears of the warnings, but not of those before the one with the number \a first. */
void
TellWarnings(ProgressSink & sink, const std::vector<Warning> & warnings, std::size_t first = 0);

} // end namespace medialvoxel

#endif
