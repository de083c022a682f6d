// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurveySummary.h"

#include "Text.h"

#include <algorithm>
#include <cstddef>

namespace medialvoxel
{
/** Bins of the histogram put together by powers of two, so that whole voxels stay the middles of bins. */
void
AddBins(ThicknessSummary & summary, const LengthHistogram & histogram)
{
  constexpr std::size_t mostBins = 64;
  constexpr double      percentShown = 99.5;
  const std::size_t     last = histogram.GetBin(histogram.GetPercentile(percentShown));
  std::size_t           width = 1;
  while ((last + width / 2) / width >= mostBins)
  {
    width *= 2;
  }
  summary.binWidth = histogram.GetBinWidth() * static_cast<double>(width);
  summary.bins.assign((last + width / 2) / width + 1, 0);
  const std::vector<std::uint64_t> & numbers = histogram.GetNumbers();
  for (std::size_t bin = 0; bin < numbers.size(); ++bin)
  {
    const std::size_t wide = (bin + width / 2) / width;
    (wide < summary.bins.size() ? summary.bins[wide] : summary.above) += numbers[bin];
  }
}

ThicknessStatistics
MakeStatistics(const LengthHistogram & histogram)
{
  ThicknessStatistics statistics;
  statistics.mean = histogram.GetMean();
  statistics.standardDeviation = histogram.GetStandardDeviation();
  std::transform(ThicknessStatistics::Percents.begin(),
                 ThicknessStatistics::Percents.end(),
                 statistics.percentiles.begin(),
                 [&](unsigned int percent) { return histogram.GetPercentile(percent); });
  return statistics;
}

ThicknessSummary
Summarize(const Survey & survey)
{
  ThicknessSummary summary =
    Summarize({ survey.GetThickness(), survey.GetThicknessByArea(), survey.GetRimCells() }, survey);
  summary.unresolvedCells = survey.GetUnresolvedCells();
  summary.uncertainCells = survey.GetUncertainty().GetTotal();
  summary.uncertainty = MakeStatistics(survey.GetUncertainty());
  return summary;
}

ThicknessSummary
Summarize(const ThicknessSums & sums, const Survey & survey)
{
  const LengthHistogram & histogram = sums.thickness;
  const LengthHistogram & byArea = sums.area;
  ThicknessSummary        summary;
  static_cast<ThicknessStatistics &>(summary) = MakeStatistics(histogram);
  summary.cells = histogram.GetTotal();
  summary.rimCells = sums.rimCells;
  summary.step = survey.GetStep();
  summary.resolution = histogram.GetBinWidth();
  summary.minimum = histogram.GetMinimum();
  summary.maximum = histogram.GetMaximum();
  summary.area = static_cast<double>(byArea.GetTotal()) * survey.GetAreaUnit();
  summary.byArea = MakeStatistics(byArea);
  AddBins(summary, histogram);
  return summary;
}

std::string
MakeThicknessCsv(const Survey & survey)
{
  const LengthHistogram &            histogram = survey.GetThickness();
  const std::vector<std::uint64_t> & numbers = histogram.GetNumbers();
  const std::vector<std::uint64_t> & areas = survey.GetThicknessByArea().GetNumbers();
  std::string                        text = "thickness,cells,area\n";
  for (std::size_t bin = histogram.GetBin(histogram.GetMinimum()); bin < numbers.size(); ++bin)
  {
    const std::uint64_t area = bin < areas.size() ? areas[bin] : 0;
    text += FormatNumber(static_cast<double>(bin) * histogram.GetBinWidth()) + ',' + std::to_string(numbers[bin]) +
            ',' + FormatNumber(static_cast<double>(area) * survey.GetAreaUnit()) + '\n';
  }
  return text;
}

} // end namespace medialvoxel
