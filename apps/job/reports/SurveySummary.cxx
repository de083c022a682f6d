// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurveySummary.h"

#include "Text.h"
#include "ValueStatistics.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace medialvoxel
{
namespace
{

// Stands beside an uncertainty, so that nobody overrates it.
constexpr const char * UncertaintyCovers =
  "noise of the values with its correlation, the place between the voxels (0.03 voxels), levels (1 % of the thickness)";
constexpr const char * UncertaintyLeavesOut =
  "wrong levels beside unseen walls, beam hardening and other artifacts, curved walls, the scale of the scan";

} // namespace

Json
MakePercentiles(const LengthHistogram & histogram, const bool areKnown)
{
  Json percentiles = Json::object();
  for (const unsigned int percent : ValueStatistics::Percents)
  {
    percentiles[std::to_string(percent)] = areKnown ? Json(histogram.GetPercentile(percent)) : Json(nullptr);
  }
  return percentiles;
}

Json
MakeBins(const LengthHistogram & histogram, const double unit)
{
  constexpr std::size_t mostBins = 64;
  constexpr double      percentShown = 99.5;
  const std::size_t     last = histogram.GetBin(histogram.GetPercentile(percentShown));
  std::size_t           width = 1; // a power of two, so that whole voxels stay the middles of bins
  while ((last + width / 2) / width >= mostBins)
  {
    width *= 2;
  }
  std::vector<double>                areas((last + width / 2) / width + 1, 0.0);
  double                             above = 0.0;
  const std::vector<std::uint64_t> & numbers = histogram.GetNumbers();
  for (std::size_t bin = 0; bin < numbers.size(); ++bin)
  {
    const std::size_t wide = (bin + width / 2) / width;
    (wide < areas.size() ? areas[wide] : above) += static_cast<double>(numbers[bin]);
  }
  std::transform(areas.begin(), areas.end(), areas.begin(), [unit](double area) { return area * unit; });
  return { { "bin_width", histogram.GetBinWidth() * static_cast<double>(width) },
           { "areas", areas },
           { "above", above * unit } };
}

Json
MakeThickness(const ThicknessSums & sums, const Survey & survey)
{
  const LengthHistogram & cells = sums.GetCells();
  const LengthHistogram & areas = sums.GetAreas();
  const unsigned int      step = survey.GetSample().GetStep();
  const bool              isKnown = cells.GetTotal() > 0;
  const auto lengthIf = [](bool isLength, double length) { return isLength ? Json(length) : Json(nullptr); };
  return { { "cells", cells.GetTotal() },
           { "unpaired_cells", sums.GetUnpairedCells() },
           { "unresolved_cells", sums.GetUnresolvedCells() },
           { "one_cell_of", step },
           { "resolution", cells.GetBinWidth() },
           { "area", static_cast<double>(areas.GetTotal()) * survey.GetAreaUnit() },
           { "mean", lengthIf(isKnown, areas.GetMean()) },
           { "standard_error", lengthIf(step > 1, sums.GetStandardErrorOfMean(step)) },
           { "standard_deviation", lengthIf(isKnown, areas.GetStandardDeviation()) },
           { "minimum", lengthIf(isKnown && step == 1, static_cast<double>(sums.GetMinimum())) },
           { "maximum", lengthIf(isKnown && step == 1, static_cast<double>(sums.GetMaximum())) },
           { "percentiles", MakePercentiles(areas, isKnown) },
           { "histogram", MakeBins(areas, survey.GetAreaUnit()) } };
}

Json
MakeUncertainty(const ThicknessSums & sums)
{
  const LengthHistogram & uncertainty = sums.GetUncertainty();
  if (uncertainty.GetTotal() == 0)
  {
    return nullptr;
  }
  return { { "cells", uncertainty.GetTotal() },
           { "mean", uncertainty.GetMean() },
           { "percentiles", MakePercentiles(uncertainty, true) },
           { "covers", UncertaintyCovers },
           { "leaves_out", UncertaintyLeavesOut } };
}

} // end namespace medialvoxel
