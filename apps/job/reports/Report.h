// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelReport_h
#define medialvoxelReport_h

#include "JobResult.h"
#include "Options.h"

#include <string>

namespace medialvoxel
{

/** All values of a result, each with its key. Table, page and Slicer show them. Values that depend on the run and the
 * machine stand at the end, after the warnings: seconds, peak_memory_bytes, bytes_read, threads, divisions. */
Json
MakeReport(const ExtractOptions & options, const JobResult & result);
Json
MakeReport(const DistanceOptions & options, const JobResult & result);
Json
MakeReport(const PartOptions & options, const JobResult & result);

/** As a file. Names of files need not be valid UTF-8. */
std::string
FormatReport(const Json & report);

} // end namespace medialvoxel

#endif
