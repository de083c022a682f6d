// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurveySummary_h
#define medialvoxelSurveySummary_h

#include "Survey.h"
#include "ThicknessSummary.h"

#include <cstdint>
#include <string>

namespace medialvoxel
{

/** Of lengths that were counted. */
ThicknessStatistics
MakeStatistics(const LengthHistogram & histogram);

/** \param histogram areas, in multiples of \a unit */
AreaBins
MakeBins(const LengthHistogram & histogram, double unit);

ThicknessSummary
Summarize(const Survey & survey);

/** Of some of the cells that a survey counts. */
ThicknessSummary
Summarize(const ThicknessSums & sums, const Survey & survey);

/** The histograms as comma-separated values: a line with the names thickness, cells and area, and one for every bin
 * from the smallest to the largest thickness, each with the length in the middle of the bin. */
std::string
MakeThicknessCsv(const Survey & survey);

} // end namespace medialvoxel

#endif
