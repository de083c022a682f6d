// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterRange.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <string_view>

namespace medialvoxel
{
namespace
{

std::optional<std::uint64_t>
ParseCluster(std::string_view text)
{
  const std::optional<std::int64_t> number = ParseInteger(text);
  return number && *number >= 0 ? std::optional<std::uint64_t>(*number) : std::nullopt;
}

std::optional<ClusterRange>
ParseRange(std::string_view text)
{
  const std::size_t dash = text.find('-');
  const auto        first = ParseCluster(text.substr(0, dash));
  const auto        last = dash == std::string_view::npos ? first : ParseCluster(text.substr(dash + 1));
  if (!first || !last || *first > *last)
  {
    return std::nullopt;
  }
  return ClusterRange{ *first, *last };
}

} // namespace

std::optional<std::vector<ClusterRange>>
ParseClusters(const std::string & text)
{
  std::vector<ClusterRange> ranges;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto        range = ParseRange(std::string_view(text).substr(begin, end - begin));
    if (!range)
    {
      return std::nullopt;
    }
    ranges.push_back(*range);
    begin = end + 1;
  }
  return ranges;
}

std::string
FormatClusters(const std::vector<std::uint64_t> & clusters)
{
  std::string text;
  for (std::size_t i = 0; i < clusters.size();)
  {
    std::size_t last = i;
    while (last + 1 < clusters.size() && clusters[last + 1] == clusters[last] + 1)
    {
      ++last;
    }
    text += (text.empty() ? "" : ",") + std::to_string(clusters[i]);
    text += last > i ? "-" + std::to_string(clusters[last]) : "";
    i = last + 1;
  }
  return text;
}

std::vector<std::uint64_t>
ListClusters(const std::vector<ClusterRange> & ranges, std::uint64_t numberOfClusters)
{
  std::vector<bool> wanted(numberOfClusters, ranges.empty());
  for (const ClusterRange & range : ranges)
  {
    if (range.last >= numberOfClusters)
    {
      Fail(ExitStatus::Usage,
           "there is no cluster ",
           range.last,
           "; the job has ",
           numberOfClusters,
           numberOfClusters == 1 ? " cluster, 0" : " clusters, 0 to " + std::to_string(numberOfClusters - 1));
    }
    std::fill(wanted.begin() + static_cast<std::ptrdiff_t>(range.first),
              wanted.begin() + static_cast<std::ptrdiff_t>(range.last) + 1,
              true);
  }
  std::vector<std::uint64_t> clusters;
  for (std::uint64_t cluster = 0; cluster < numberOfClusters; ++cluster)
  {
    if (wanted[cluster])
    {
      clusters.push_back(cluster);
    }
  }
  return clusters;
}

std::uint64_t
ChooseCluster(const std::set<std::uint64_t> &      free,
              const std::set<std::uint64_t> &      busy,
              const std::optional<std::uint64_t> & last)
{
  if (last && free.count(*last + 1) > 0)
  {
    return *last + 1;
  }
  ClusterRange longest{ *free.begin(), *free.begin() };
  ClusterRange run = longest;
  for (const std::uint64_t cluster : free)
  {
    run.first = cluster > run.last + 1 ? cluster : run.first;
    run.last = cluster;
    longest = run.last - run.first > longest.last - longest.first ? run : longest;
  }
  const bool isApproached = longest.first > 0 && busy.count(longest.first - 1) > 0;
  return isApproached ? longest.first + (longest.last - longest.first + 1) / 2 : longest.first;
}

} // end namespace medialvoxel
