// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceJson.h"

#include "FillIn.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::size_t MostPlacesOfReport = 100;
constexpr std::size_t LongestRow = 512;

template <typename TArray>
Json
ToJson(const TArray & values, unsigned int dimension)
{
  Json json = Json::array();
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    json.push_back(values[axis]);
  }
  return json;
}

Json
PlaceToJson(const WallPlace & place, unsigned int dimension)
{
  Json json{ { "area", place.area },   { "area_beyond_limit", place.areaBeyond },
             { "cells", place.cells }, { "minimum", place.minimum },
             { "mean", place.mean },   { "maximum", place.maximum } };
  json.update(LocationToJson(place, dimension));
  json.update(Json{ { "first", ToJson(place.first, dimension) }, { "last", ToJson(place.last, dimension) } });
  return json;
}

Json
SummaryToJson(const PlaceSummary & summary)
{
  Json places = Json::array();
  for (std::size_t i = 0; i < std::min(summary.places.size(), MostPlacesOfReport); ++i)
  {
    places.push_back(PlaceToJson(summary.places[i], summary.dimension));
  }
  Json worst;
  for (const WallPlace & place : summary.places)
  {
    const double length = summary.kind == PlaceKind::Thin ? place.minimum : place.maximum;
    const bool   isWorse = worst.is_null() || (summary.kind == PlaceKind::Thin ? length < worst : length > worst);
    worst = isWorse ? Json(length) : worst;
  }
  return { { "limit", summary.limit },
           { "grow_limit", summary.growLimit },
           { "min_place_area", summary.minimumPlaceArea },
           { "number", summary.number },
           { "cells", summary.cells },
           { "area", summary.area },
           { "area_beyond_limit", summary.areaBeyond },
           { "worst", worst },
           { "smaller", summary.smaller },
           { "places", places } };
}

/** Text with a column for each axis. */
std::string
ForEachAxis(const unsigned int dimension, const std::string & before, const std::array<const char *, 3> & axes)
{
  std::string text;
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    text += "," + before + axes[axis];
  }
  return text;
}

} // namespace

Json
LocationToJson(const WallLocation & wall, unsigned int dimension)
{
  return { { "uncertainty", wall.uncertainty ? Json(*wall.uncertainty) : Json(nullptr) },
           { "center", ToJson(wall.center, dimension) },
           { "index", ToJson(wall.index, dimension) },
           { "sides", { ToJson(wall.sideA, dimension), ToJson(wall.sideB, dimension) } },
           { "at_edge", wall.isAtEdge } };
}

std::string
MakePlacesCsv(const std::vector<PlaceSummary> & summaries)
{
  const unsigned int dimension = summaries.empty() ? 3 : summaries.front().dimension;
  std::string        text = "kind,place,area,area_beyond_limit,cells,minimum,mean,maximum";
  std::string        row = ",{area},{area_beyond_limit},{cells},{minimum},{mean},{maximum}";
  for (const auto & [path, name] : { std::pair("center", ""),
                                     std::pair("index", "index_"),
                                     std::pair("sides.0", "side_a_"),
                                     std::pair("sides.1", "side_b_"),
                                     std::pair("first", "first_"),
                                     std::pair("last", "last_") })
  {
    text += ForEachAxis(dimension, name, { "x", "y", "z" });
    row += ForEachAxis(dimension, "{" + std::string(path) + ".", { "0}", "1}", "2}" });
  }
  text += ",uncertainty,at_edge\n";
  row += ",[uncertainty?{uncertainty}],[at_edge?1][!at_edge?0]";
  const std::size_t rows =
    std::accumulate(summaries.begin(), summaries.end(), std::size_t{ 1 }, [](std::size_t sum, const auto & summary) {
      return sum + summary.places.size();
    });
  text.reserve(rows * LongestRow);
  for (const PlaceSummary & summary : summaries)
  {
    std::size_t number = 0;
    for (const WallPlace & place : summary.places)
    {
      text += std::string(GetName(summary.kind)) + ',' + std::to_string(++number);
      text += FillIn(row, PlaceToJson(place, dimension)) + '\n';
    }
  }
  return text;
}

Json
MakePlacesJson(const std::vector<PlaceSummary> & summaries)
{
  Json json{ { GetName(PlaceKind::Thin), nullptr }, { GetName(PlaceKind::Thick), nullptr } };
  for (const PlaceSummary & summary : summaries)
  {
    json[GetName(summary.kind)] = SummaryToJson(summary);
  }
  return json;
}

} // end namespace medialvoxel
