// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurveySummary_h
#define medialvoxelSurveySummary_h

#include "Json.h"
#include "Survey.h"

#include <string>

namespace medialvoxel
{

/** Percentiles of lengths that were counted, by their percents. Null each, unless they are known. */
Json
MakePercentiles(const LengthHistogram & histogram, bool areKnown);

/** Area for each thickness. Bin k has the lengths that are nearest to k times the width. There are at most 64 bins;
 * they leave out less than one of two hundred parts of the area, which is above.
 * \param histogram areas, in multiples of \a unit */
Json
MakeBins(const LengthHistogram & histogram, double unit);

/** Thickness of the walls at the paired medial cells, in the units of the job's lengths, for a report.
 * Cells count as much as the area of the sheet in them. Lengths are null without cells.
 * \param sums of all or some of the cells that the survey counts */
Json
MakeThickness(const ThicknessSums & sums, const Survey & survey);

/** Uncertainty of that thickness, with its scope; null where it is not known. */
Json
MakeUncertainty(const ThicknessSums & sums);

} // end namespace medialvoxel

#endif
