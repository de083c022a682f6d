// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurveySummary_h
#define medialvoxelSurveySummary_h

#include "Survey.h"
#include "ThicknessSummary.h"

#include <string>

namespace medialvoxel
{

ThicknessSummary
Summarize(const Survey & survey);

/** The histograms as comma-separated values: a line with the names thickness, cells and area, and one for every bin
 * from the smallest to the largest thickness, each with the length in the middle of the bin. */
std::string
MakeThicknessCsv(const Survey & survey);

} // end namespace medialvoxel

#endif
