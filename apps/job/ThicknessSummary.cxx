// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ThicknessSummary.h"

#include <algorithm>
#include <cstddef>

namespace medialvoxel
{
namespace
{

/** Bins of the histogram put together by powers of two, so that whole voxels stay the middles of bins. */
void
AddBins(ThicknessSummary & summary, const itk::MedialVoxelHistogram & histogram)
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

} // namespace

ThicknessSummary
Summarize(const itk::MedialVoxelHistogram & histogram, unsigned int step)
{
  ThicknessSummary summary;
  summary.cells = histogram.GetTotal();
  summary.step = step;
  summary.resolution = histogram.GetBinWidth();
  summary.mean = histogram.GetMean();
  summary.standardDeviation = histogram.GetStandardDeviation();
  summary.minimum = histogram.GetMinimum();
  summary.maximum = histogram.GetMaximum();
  std::transform(ThicknessSummary::Percents.begin(),
                 ThicknessSummary::Percents.end(),
                 summary.percentiles.begin(),
                 [&](unsigned int percent) { return histogram.GetPercentile(percent); });
  AddBins(summary, histogram);
  return summary;
}

} // end namespace medialvoxel
