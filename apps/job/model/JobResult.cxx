// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobResult.h"

#include <algorithm>

namespace medialvoxel
{

WallVerdict
GetVerdict(const JobResult & result)
{
  const auto & places = result.places;
  const auto & warnings = result.warnings;
  if (std::any_of(places.begin(), places.end(), [](const PlaceSummary & summary) {
        return summary.kind == PlaceKind::Thin && summary.number > 0;
      }))
  {
    return WallVerdict::TooThin;
  }
  const bool lacksEvidence =
    std::any_of(warnings.begin(), warnings.end(), [](const Warning & warning) { return warning.isOfEvidence; });
  return lacksEvidence ? WallVerdict::NotMeasured : WallVerdict::Good;
}

bool
IsSmoothed(const ExtractOptions & options, const JobResult & result)
{
  ExtractOptions known = options;
  known.roughness = result.roughness;
  return GetSmoothing(known) == Smoothing::On;
}

} // end namespace medialvoxel
