// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJsonLimits_h
#define medialvoxelJsonLimits_h

#include <nlohmann/json.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace medialvoxel
{

/** Nested values: copying, comparing and printing recurse into each. */
constexpr int DeepestJson = 64;

/** Parses text of unknown origin: an empty list takes two bytes of text, and thirty times as many of memory.
 * \param mostValues lists and objects included
 * \throw TJson::exception for text that is no JSON, and for numbers out of range
 * \throw std::length_error beyond the limits */
template <typename TJson>
TJson
ParseJson(const std::string & text, std::uint64_t mostValues)
{
  using Event = typename TJson::parse_event_t;
  std::uint64_t numberOfValues = 0;
  return TJson::parse(text, [&numberOfValues, mostValues](int depth, Event event, TJson &) {
    const bool isContainer = event == Event::object_start || event == Event::array_start;
    const bool isTooDeep = isContainer && depth >= DeepestJson;
    numberOfValues += isContainer || event == Event::value ? 1 : 0;
    if (isTooDeep || numberOfValues > mostValues)
    {
      throw std::length_error("more than " + (isTooDeep ? std::to_string(DeepestJson) + " values within each other"
                                                        : std::to_string(mostValues) + " values"));
    }
    return true;
  });
}

} // end namespace medialvoxel

#endif
