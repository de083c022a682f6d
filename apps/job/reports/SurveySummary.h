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

/** Sums over measured cells. */
struct ThicknessSums
{
  const LengthHistogram & thickness;
  const LengthHistogram & area;
  std::uint64_t           rimCells{ 0 };
};

/** Of lengths that were counted. */
ThicknessStatistics
MakeStatistics(const LengthHistogram & histogram);

/** Sets the bins of a summary. */
void
AddBins(ThicknessSummary & summary, const LengthHistogram & histogram);

ThicknessSummary
Summarize(const Survey & survey);

/** Of some of the cells that a survey measures. */
ThicknessSummary
Summarize(const ThicknessSums & sums, const Survey & survey);

/** The histograms as comma-separated values: a line with the names thickness, cells and area, and one for every bin
 * from the smallest to the largest thickness, each with the length in the middle of the bin. */
std::string
MakeThicknessCsv(const Survey & survey);

} // end namespace medialvoxel

#endif
