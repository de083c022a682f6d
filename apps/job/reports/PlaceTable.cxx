// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceTable.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace medialvoxel
{
namespace
{

constexpr std::size_t MostPlacesOfReport = 100;
constexpr std::size_t MostPlacesOfPage = 20;
constexpr std::size_t LongestRow = 512;

const std::array<const char *, 3> AxisNames{ "x", "y", "z" };

std::string
FormatValue(double value)
{
  return FormatNumber(value);
}

std::string
FormatValue(std::int64_t value)
{
  return std::to_string(value);
}

/** A point or index of a place: a column for each axis. */
struct Column
{
  const char * name;
  std::string (*format)(const WallPlace & place, unsigned int axis);
};

template <auto VMember>
std::string
Format(const WallPlace & place, unsigned int axis)
{
  return FormatValue((place.*VMember)[axis]);
}

constexpr std::array<Column, 6> Columns{ {
  { "", Format<&WallPlace::center> },
  { "index_", Format<&WallPlace::index> },
  { "side_a_", Format<&WallPlace::sideA> },
  { "side_b_", Format<&WallPlace::sideB> },
  { "first_", Format<&WallPlace::first> },
  { "last_", Format<&WallPlace::last> },
} };

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
  return { { "area", place.area },
           { "area_beyond_limit", place.areaBeyond },
           { "cells", place.cells },
           { "minimum", place.minimum },
           { "mean", place.mean },
           { "maximum", place.maximum },
           { "center", ToJson(place.center, dimension) },
           { "index", ToJson(place.index, dimension) },
           { "sides", { ToJson(place.sideA, dimension), ToJson(place.sideB, dimension) } },
           { "first", ToJson(place.first, dimension) },
           { "last", ToJson(place.last, dimension) } };
}

Json
SummaryToJson(const PlaceSummary & summary)
{
  Json places = Json::array();
  for (std::size_t i = 0; i < std::min(summary.places.size(), MostPlacesOfReport); ++i)
  {
    places.push_back(PlaceToJson(summary.places[i], summary.dimension));
  }
  return { { "limit", summary.limit },
           { "grow_limit", summary.growLimit },
           { "smallest_area", summary.smallestArea },
           { "number", summary.number },
           { "cells", summary.cells },
           { "area", summary.area },
           { "area_beyond_limit", summary.areaBeyond },
           { "smaller", summary.smaller },
           { "places", places } };
}

template <typename TArray>
std::string
JoinNumbers(const TArray & values)
{
  return Join(values, " ", [](auto value) { return FormatValue(value); });
}

/** What a view of the place needs to know, as attributes. */
std::string
MakeViewAttributes(std::size_t number, const WallPlace & place, PlaceKind kind)
{
  const std::string length = FormatShort(kind == PlaceKind::Thin ? place.minimum : place.maximum);
  return " data-center=\"" + JoinNumbers(place.center) + "\" data-sides=\"" + JoinNumbers(place.sideA) + ' ' +
         JoinNumbers(place.sideB) + "\" data-box=\"" + JoinNumbers(place.first) + ' ' + JoinNumbers(place.last) +
         "\" data-length=\"" + length + "\" data-text=\"" + GetName(kind) + " place " + std::to_string(number) + ": " +
         (kind == PlaceKind::Thin ? "minimum " : "maximum ") + length + ", area " + FormatShort(place.areaBeyond) +
         ", at " + Join(place.center, ", ", FormatShort) + '"';
}

std::string
MakeHtmlRow(std::size_t number, const WallPlace & place, PlaceKind kind, unsigned int dimension)
{
  const auto cell = [](const std::string & text) { return "<td class=\"number\">" + text + "</td>"; };
  const auto list = [dimension](const auto & values, auto format) {
    std::string text;
    for (unsigned int axis = 0; axis < dimension; ++axis)
    {
      text += (axis == 0 ? "" : ", ") + format(values[axis]);
    }
    return text;
  };
  const auto whole = [](std::int64_t value) { return std::to_string(value); };
  return "<tr class=\"place\"" + MakeViewAttributes(number, place, kind) + ">" + cell(std::to_string(number)) +
         cell(FormatShort(place.areaBeyond)) + cell(FormatShort(place.area)) + cell(std::to_string(place.cells)) +
         cell(FormatShort(place.minimum)) + cell(FormatShort(place.mean)) + cell(FormatShort(place.maximum)) +
         cell(list(place.center, FormatShort)) + cell(list(place.index, whole)) +
         cell(list(place.first, whole) + " to " + list(place.last, whole)) + "</tr>\n";
}

std::string
GetSide(const PlaceSummary & summary)
{
  return summary.kind == PlaceKind::Thin ? "below " : "above ";
}

/** What follows the area beyond the limit. */
std::string
DescribeLimit(const PlaceSummary & summary)
{
  return GetSide(summary) + FormatShort(summary.limit) + "; area " + FormatShort(summary.area) + " with all that is " +
         GetSide(summary) + FormatShort(summary.growLimit) + " around";
}

} // namespace

std::string
MakePlacesCsv(const std::vector<PlaceSummary> & summaries)
{
  const unsigned int dimension = summaries.empty() ? 3 : summaries.front().dimension;
  std::string        text = "kind,place,area,area_beyond_limit,cells,minimum,mean,maximum";
  for (const Column & column : Columns)
  {
    for (unsigned int axis = 0; axis < dimension; ++axis)
    {
      text += std::string(",") + column.name + AxisNames[axis];
    }
  }
  text += '\n';
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
      text += std::string(GetName(summary.kind)) + ',' + std::to_string(++number) + ',' + FormatNumber(place.area) +
              ',' + FormatNumber(place.areaBeyond) + ',' + std::to_string(place.cells) + ',' +
              FormatNumber(place.minimum) + ',' + FormatNumber(place.mean) + ',' + FormatNumber(place.maximum);
      for (const Column & column : Columns)
      {
        for (unsigned int axis = 0; axis < dimension; ++axis)
        {
          text += ',' + column.format(place, axis);
        }
      }
      text += '\n';
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

std::string
MakePlacesHtml(const std::vector<PlaceSummary> & summaries, const std::string & unit)
{
  std::string text;
  for (const PlaceSummary & summary : summaries)
  {
    const std::string kind = GetName(summary.kind);
    const std::size_t rows = std::min(summary.places.size(), MostPlacesOfPage);
    text += "<h2>Places that are too " + kind + "</h2>\n<p>" + std::to_string(summary.number) + " places, area " +
            FormatShort(summary.areaBeyond) + ' ' + DescribeLimit(summary) + "; " + std::to_string(summary.smaller) +
            " with less than " + FormatShort(summary.smallestArea) + ' ' + GetSide(summary) +
            "the limit are left out.</p>\n";
    if (rows > 0)
    {
      text += "<table>\n<tr><th>place</th><th>area " + GetSide(summary) + FormatShort(summary.limit) +
              "</th><th>with its surroundings</th><th>cells</th><th>minimum</th><th>mean</th><th>maximum</th>"
              "<th>position</th><th>index</th><th>extent</th></tr>\n";
      for (std::size_t i = 0; i < rows; ++i)
      {
        text += MakeHtmlRow(i + 1, summary.places[i], summary.kind, summary.dimension);
      }
      text += "</table>\n<p class=\"muted\">Thickness in " + unit +
              ". Positions are in the space of the volume, at the " +
              (summary.kind == PlaceKind::Thin ? "thinnest" : "thickest") + " cell. These are " + std::to_string(rows) +
              " of " + std::to_string(summary.number) + " places.</p>\n";
    }
  }
  return text;
}

TextTable
DescribePlaces(const std::vector<PlaceSummary> & summaries)
{
  TextTable table;
  for (const PlaceSummary & summary : summaries)
  {
    const std::string kind = GetName(summary.kind);
    std::string       text = std::to_string(summary.number) + ", area " + FormatShort(summary.areaBeyond) + ' ' +
                       GetSide(summary) + FormatShort(summary.limit);
    if (!summary.places.empty())
    {
      const WallPlace & first = summary.places.front();
      text += ", the largest " + FormatShort(first.areaBeyond) + " with ";
      text += summary.kind == PlaceKind::Thin ? "minimum " + FormatShort(first.minimum)
                                              : "maximum " + FormatShort(first.maximum);
    }
    table.emplace_back(kind + " places", text);
  }
  return table;
}

} // end namespace medialvoxel
