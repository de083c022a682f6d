// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurveySummary.h"

#include "Text.h"

#include <algorithm>
#include <cstddef>

namespace medialvoxel
{

AreaBins
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
  AreaBins bins;
  bins.width = histogram.GetBinWidth() * static_cast<double>(width);
  bins.areas.assign((last + width / 2) / width + 1, 0.0);
  const std::vector<std::uint64_t> & numbers = histogram.GetNumbers();
  for (std::size_t bin = 0; bin < numbers.size(); ++bin)
  {
    const std::size_t wide = (bin + width / 2) / width;
    (wide < bins.areas.size() ? bins.areas[wide] : bins.above) += static_cast<double>(numbers[bin]);
  }
  std::transform(bins.areas.begin(), bins.areas.end(), bins.areas.begin(), [unit](double area) { return area * unit; });
  bins.above *= unit;
  return bins;
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
  ThicknessSummary summary = Summarize(survey.GetSums(), survey);
  summary.unresolvedCells = survey.GetUnresolvedCells();
  summary.uncertainCells = survey.GetUncertainty().GetTotal();
  summary.uncertainty = MakeStatistics(survey.GetUncertainty());
  return summary;
}

ThicknessSummary
Summarize(const ThicknessSums & sums, const Survey & survey)
{
  ThicknessSummary summary;
  static_cast<ThicknessStatistics &>(summary) = MakeStatistics(sums.GetAreas());
  summary.cells = sums.GetCells().GetTotal();
  summary.rimCells = sums.GetRimCells();
  summary.step = survey.GetSample().GetStep();
  summary.resolution = sums.GetCells().GetBinWidth();
  if (summary.step > 1)
  {
    summary.standardError = sums.GetStandardErrorOfMean(summary.step);
  }
  else if (summary.cells > 0)
  {
    summary.minimum = sums.GetCells().GetMinimum();
    summary.maximum = sums.GetCells().GetMaximum();
  }
  summary.area = static_cast<double>(sums.GetAreas().GetTotal()) * survey.GetAreaUnit();
  summary.bins = MakeBins(sums.GetAreas(), survey.GetAreaUnit());
  return summary;
}

std::string
MakeThicknessCsv(const Survey & survey)
{
  const LengthHistogram &            histogram = survey.GetSums().GetCells();
  const std::vector<std::uint64_t> & numbers = histogram.GetNumbers();
  const std::vector<std::uint64_t> & areas = survey.GetSums().GetAreas().GetNumbers();
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
