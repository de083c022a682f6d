// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ValueStatistics.h"

#include "Errors.h"
#include "Text.h"
#include "ValueHistogram.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

/** Calls function(vector, times) for the values of all parts of an image, from front to back: one value for all voxels
 * of a part without a chunk. */
template <typename TValue, typename TFunction>
void
ForEachValue(itk::MedialVoxelValueSource & source,
             const itk::MedialVoxelBox &   image,
             const ReadObserver &          observer,
             TFunction &&                  function)
{
  const unsigned int  last = image.Extent(2) > 1 ? 2 : 1;
  std::vector<TValue> values;
  source.ForEachSpan(image, [&](const itk::MedialVoxelBox & part, const itk::MedialVoxelValueView & view) {
    observer(static_cast<double>(part.lower[last]) / static_cast<double>(image.upper[last]));
    const auto * const first = static_cast<const TValue *>(view.values);
    values.clear();
    if (view.areEqual)
    {
      values.push_back(*first);
      function(values, static_cast<std::uint64_t>(part.NumberOfVoxels()));
      return;
    }
    itk::MedialVoxelForEachRow(part, view.strides, [&](const std::int64_t offset, const itk::MedialVoxelBox & row) {
      values.insert(values.end(), first + offset, first + offset + row.Extent(0));
    });
    function(values, 1);
  });
}

/** The last bin of the lower class for which the variance between both classes is largest; the number of a bin stands
 * for its values, as the bins are equal. */
struct OtsuBin
{
  std::optional<std::size_t> last;
  double                     explained{ 0.0 }; ///< share of the variance that is between the classes
};

/** |a b - c d|, whose products have 128 bits. */
double
GetDifference(std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d)
{
  struct Product
  {
    std::uint64_t high;
    std::uint64_t low;
  };
  const auto multiply = [](std::uint64_t x, std::uint64_t y) {
    constexpr unsigned int  half = 32;
    constexpr std::uint64_t mask = 0xFFFFFFFF;
    const std::uint64_t     low = (x & mask) * (y & mask);
    const std::uint64_t     middle = (x >> half) * (y & mask) + (low >> half);
    const std::uint64_t     other = (x & mask) * (y >> half) + (middle & mask);
    const std::uint64_t     high = (x >> half) * (y >> half) + (middle >> half) + (other >> half);
    return Product{ high, (other << half) | (low & mask) };
  };
  Product more = multiply(a, b);
  Product less = multiply(c, d);
  if (more.high < less.high || (more.high == less.high && more.low < less.low))
  {
    std::swap(more, less);
  }
  const std::uint64_t high = more.high - less.high - (more.low < less.low ? 1 : 0);
  return std::ldexp(static_cast<double>(high), 64) + static_cast<double>(more.low - less.low);
}

OtsuBin
FindOtsuBin(const std::vector<std::uint64_t> & counts)
{
  // Whole numbers of 64 bits hold them for up to 2^48 voxels.
  std::uint64_t all = 0;
  std::uint64_t sum = 0;
  for (std::size_t bin = 0; bin < counts.size(); ++bin)
  {
    all += counts[bin];
    sum += counts[bin] * bin;
  }
  const double               mean = static_cast<double>(sum) / static_cast<double>(all);
  std::uint64_t              below = 0;
  std::uint64_t              sumBelow = 0;
  double                     variance = 0.0;
  double                     largest = 0.0;
  std::optional<std::size_t> best;
  for (std::size_t bin = 0; bin < counts.size(); ++bin)
  {
    if (counts[bin] == 0)
    {
      continue; // as the bin before, whose threshold is lower
    }
    below += counts[bin];
    sumBelow += counts[bin] * bin;
    const double distance = static_cast<double>(bin) - mean;
    variance += static_cast<double>(counts[bin]) * (distance * distance);
    const double difference = GetDifference(sumBelow, all, sum, below);
    const double between =
      below == all ? 0.0 : difference / static_cast<double>(below) * (difference / static_cast<double>(all - below));
    if (between > largest)
    {
      largest = between;
      best = bin;
    }
  }
  return { best, variance > 0.0 ? largest / (variance * static_cast<double>(all)) : 0.0 };
}

/** Whether a bin at an end of the range, the gap to the next one that has values, and the others are as with padding.
 */
bool
IsPadding(const std::vector<std::uint64_t> & counts, std::size_t bin, std::size_t gap, std::size_t range)
{
  constexpr std::uint64_t    share = 20; // one of so many values
  constexpr double           leastExplained = 0.85;
  const std::uint64_t        all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 });
  std::vector<std::uint64_t> others = counts;
  others[bin] = 0;
  return gap >= range && counts[bin] >= all / share && FindOtsuBin(others).explained >= leastExplained;
}

/** The bin of values that are no measurement: scanners fill the outside of their field of view with one value far
 * below all others, or far above. Without it two classes are left, or it may be a background. */
std::optional<std::size_t>
FindPadding(const std::vector<std::uint64_t> & counts, std::size_t zero)
{
  constexpr std::size_t partBelow = 10; // the gap is at least one of so many parts of the range of the others
  constexpr std::size_t timesAbove = 4; // or so many times as much: walls of metal are far above others too
  const auto            isFilled = [](std::uint64_t count) { return count > 0; };
  const auto            toBin = [&counts](auto place) { return static_cast<std::size_t>(place - counts.begin()); };
  const auto            findNext = [&](std::size_t bin) {
    return toBin(std::find_if(counts.begin() + static_cast<std::ptrdiff_t>(bin), counts.end(), isFilled));
  };
  const auto findLast = [&](std::size_t end) { // behind it
    const auto from = counts.rend() - static_cast<std::ptrdiff_t>(end);
    return toBin(std::find_if(from, counts.rend(), isFilled).base());
  };
  const std::size_t lowest = findNext(0);
  const std::size_t highest = findLast(counts.size());
  if (lowest + 1 >= highest)
  {
    return std::nullopt; // one value, or none
  }
  const std::size_t second = findNext(lowest + 1);
  const std::size_t lastButOne = findLast(highest - 1);
  if (lowest < zero && IsPadding(counts, lowest, second - lowest, (highest - second) / partBelow))
  {
    return lowest;
  }
  return IsPadding(counts, highest - 1, highest - lastButOne, (lastButOne - lowest) * timesAbove)
           ? std::optional<std::size_t>(highest - 1)
           : std::nullopt;
}

/** Removes the padding from the counts, and reports it. */
template <typename TValue>
void
RemovePadding(const ValueBins<TValue> &    bins,
              const Paddings &             paddings,
              std::vector<std::uint64_t> & counts,
              ValueStatistics &            statistics)
{
  const auto remove = [&](std::size_t bin, const std::array<double, 2> & values) {
    statistics.padding = statistics.padding.value_or(values);
    statistics.padding = { { std::min(values[0], (*statistics.padding)[0]),
                             std::max(values[1], (*statistics.padding)[1]) } };
    statistics.paddingValues += counts[bin];
    counts[bin] = 0;
  };
  for (std::size_t bin = 0; bin < counts.size() && !paddings.empty(); ++bin)
  {
    const double begin = bins.GetBegin(bin);
    const auto   hasBin = [&](const std::array<double, 2> & padding) {
      return begin <= padding[1] && (begin >= padding[0] || begin + bins.GetWidth() > padding[0]);
    };
    const auto found = std::find_if(paddings.begin(), paddings.end(), hasBin);
    if (counts[bin] > 0 && found != paddings.end())
    {
      remove(bin, *found);
    }
  }
  if (statistics.padding)
  {
    return;
  }
  if (const std::optional<std::size_t> bin = FindPadding(counts, bins.GetBinOfZero()))
  {
    remove(*bin, { { bins.GetBegin(*bin), bins.GetBegin(*bin) } });
  }
}

template <typename TValue>
double
FindPercentile(const ValueBins<TValue> &          bins,
               const std::vector<std::uint64_t> & counts,
               std::uint64_t                      values,
               unsigned int                       percent)
{
  // Without the product, which may exceed 64 bits.
  const std::uint64_t rank = values / 100 * percent + (values % 100 * percent + 99) / 100;
  std::uint64_t       sum = 0;
  for (std::size_t bin = 0; bin < counts.size(); ++bin)
  {
    sum += counts[bin];
    if (sum >= rank && sum > 0)
    {
      return bins.GetBegin(bin);
    }
  }
  return bins.GetBegin(counts.size() - 1);
}

template <typename TValue>
ValueStatistics
Summarize(const ValueRange<TValue> & range, const ValueBins<TValue> & bins, const Paddings & paddings)
{
  ValueStatistics statistics;
  statistics.values = range.GetCount();
  statistics.excluded = range.GetExcluded();
  statistics.minimum = static_cast<double>(range.GetMinimum());
  statistics.maximum = static_cast<double>(range.GetMaximum());
  statistics.mean = range.GetMean();
  statistics.binWidth = bins.GetWidth();
  std::vector<std::uint64_t> counts = bins.GetCounts();
  RemovePadding(bins, paddings, counts, statistics);
  for (std::size_t i = 0; i < statistics.percentiles.size(); ++i)
  {
    const std::uint64_t values = range.GetCount() - statistics.paddingValues;
    statistics.percentiles[i] = FindPercentile(bins, counts, values, ValueStatistics::Percents[i]);
  }
  const std::optional<std::size_t> bin = FindOtsuBin(counts).last;
  statistics.otsu = bin ? std::optional<double>(bins.GetBegin(*bin + 1)) : std::nullopt;
  const bool        hasZero = statistics.minimum <= 0.0 && statistics.maximum >= 0.0;
  const std::size_t zero = hasZero ? bins.GetBinOfZero() : counts.size();
  for (std::size_t place = 0; place < counts.size(); ++place)
  {
    const std::uint64_t others = place == zero ? 0 : counts[place];
    statistics.different += counts[place] > 0 ? 1 : 0;
    statistics.otherThanZero += others;
    statistics.faint += bin && place <= *bin ? others : 0;
  }
  return statistics;
}

/** \param forEach passes all values to its argument, and calls an observer meanwhile */
template <typename TValue, typename TForEach>
ValueStatistics
Measure(const Paddings & paddings, const ReadObserver & observer, TForEach && forEach)
{
  ValueRange<TValue> range;
  using Limits = std::numeric_limits<TValue>;
  if constexpr (std::is_integral<TValue>::value && sizeof(TValue) <= 2)
  {
    // A bin for each value that the type has, so that once through the file is enough.
    ValueBins<TValue> bins(Limits::lowest(), Limits::max(), MostValueBins);
    forEach(observer, [&](const std::vector<TValue> & values, std::uint64_t times) { bins.Add(values, times); });
    bins.Finish();
    for (std::size_t bin = 0; bin < bins.GetCounts().size(); ++bin)
    {
      if (bins.GetCounts()[bin] > 0)
      {
        range.Add({ static_cast<TValue>(bins.GetBegin(bin)) }, bins.GetCounts()[bin]);
      }
    }
    return Summarize(range, bins, paddings);
  }
  else
  {
    forEach([&](double share) { observer(0.5 * share); },
            [&](const auto & values, std::uint64_t times) { range.Add(values, times); });
    if (range.GetCount() == 0)
    {
      ValueStatistics none;
      none.excluded = range.GetExcluded();
      return none;
    }
    ValueBins<TValue> bins(range.GetMinimum(), range.GetMaximum(), MostValueBins);
    forEach([&](double share) { observer(0.5 + 0.5 * share); },
            [&](const auto & values, std::uint64_t times) { bins.Add(values, times); });
    bins.Finish();
    return Summarize(range, bins, paddings);
  }
}

} // namespace

ValueStatistics
MeasureValues(itk::MedialVoxelValueSource & source,
              const itk::MedialVoxelBox &   image,
              const Paddings &              paddings,
              const ReadObserver &          observer)
{
  return DispatchPixelType(source.GetValueType(), [&](auto zero) {
    using Value = decltype(zero);
    return Measure<Value>(paddings, observer, [&](const ReadObserver & share, auto && function) {
      ForEachValue<Value>(source, image, share, function);
    });
  });
}

void
SetOtsuThreshold(JobOptions & options, const VolumeHeader & header, const ValueStatistics & statistics)
{
  if (!statistics.otsu)
  {
    Fail(ExitStatus::Refused,
         header.fileName.string(),
         statistics.values == 0 ? ": it has no finite values"
                                : ": all its values are " + FormatNumber(statistics.minimum),
         "; the threshold of Otsu needs two different ones");
  }
  if (options.upperThreshold && itk::MedialVoxelExactNumber(*statistics.otsu).IsAbove(*options.upperThreshold))
  {
    Fail(ExitStatus::Usage,
         header.fileName.string(),
         ": its threshold of Otsu, ",
         FormatNumber(*statistics.otsu),
         ", is greater than upper threshold ",
         options.upperThreshold->Format(),
         "; it must not be");
  }
  options.lowerThreshold = *statistics.otsu;
}

TextTable
DescribeValues(const ValueStatistics & statistics)
{
  TextTable table{ { "values", std::to_string(statistics.values) } };
  if (statistics.excluded > 0)
  {
    table.emplace_back("excluded", std::to_string(statistics.excluded) + " not a number or infinite");
  }
  if (statistics.values == 0)
  {
    return table;
  }
  table.emplace_back("minimum", FormatNumber(statistics.minimum));
  table.emplace_back("maximum", FormatNumber(statistics.maximum));
  table.emplace_back("mean", FormatNumber(statistics.mean));
  for (std::size_t i = 0; i < statistics.percentiles.size(); ++i)
  {
    table.emplace_back(std::to_string(ValueStatistics::Percents[i]) + " %", FormatNumber(statistics.percentiles[i]));
  }
  if (statistics.padding)
  {
    const auto [from, to] = *statistics.padding;
    table.emplace_back("padding",
                       FormatNumber(from) + (from < to ? " to " + FormatNumber(to) : "") + ", " +
                         std::to_string(statistics.paddingValues) + " voxels, left out of percentiles and otsu");
  }
  table.emplace_back("otsu", statistics.otsu ? FormatNumber(*statistics.otsu) : "-");
  if (statistics.binWidth > 0)
  {
    table.emplace_back("bin width", FormatNumber(statistics.binWidth) + ", of percentiles and otsu");
  }
  return table;
}

} // end namespace medialvoxel
