// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobResult.h"

#include "Text.h"

#include <algorithm>

namespace medialvoxel
{

bool
HasThinPlaces(const JobResult & result)
{
  return std::any_of(result.places.begin(), result.places.end(), [](const PlaceSummary & summary) {
    return summary.kind == PlaceKind::Thin && summary.number > 0;
  });
}

bool
IsSmoothed(const ExtractOptions & options, const JobResult & result)
{
  ExtractOptions known = options;
  known.roughness = result.roughness;
  return GetSmoothing(known) == Smoothing::On;
}

std::string
DescribeSmoothing(const ExtractOptions & options, const JobResult & result)
{
  const std::string text = IsSmoothed(options, result) ? "yes" : "no";
  return result.roughness ? text + ", roughness " + FormatFixed(100 * result.roughness->GetRatio(), 2) + " %" : text;
}

} // end namespace medialvoxel
