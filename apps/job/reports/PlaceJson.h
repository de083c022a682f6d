// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceJson_h
#define medialvoxelPlaceJson_h

#include "Json.h"
#include "PlaceSummary.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** The keys of a wall in a report. */
Json
LocationToJson(const WallLocation & wall, unsigned int dimension);

/** All listed places as comma-separated values, thin ones first. */
std::string
MakePlacesCsv(const std::vector<PlaceSummary> & summaries);

/** For a report: sums over all places of each kind, and the first of them; null for kinds that were not looked for. */
Json
MakePlacesJson(const std::vector<PlaceSummary> & summaries);

} // end namespace medialvoxel

#endif
