// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceTable_h
#define medialvoxelPlaceTable_h

#include "PlaceSummary.h"
#include "SealedJson.h"
#include "Text.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** All listed places as comma-separated values, thin ones first. */
std::string
MakePlacesCsv(const std::vector<PlaceSummary> & summaries);

/** For a report: sums over all places of each kind, and the first of them; null for kinds that were not looked for. */
Json
MakePlacesJson(const std::vector<PlaceSummary> & summaries);

/** For a page: a table of the first places of each kind. \param unit of lengths */
std::string
MakePlacesHtml(const std::vector<PlaceSummary> & summaries, const std::string & unit);

/** For the terminal: a row for each kind. */
TextTable
DescribePlaces(const std::vector<PlaceSummary> & summaries);

} // end namespace medialvoxel

#endif
