// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJson_h
#define medialvoxelJson_h

#include <nlohmann/json.hpp>

#include <optional>

namespace medialvoxel
{

/** Members keep their order. */
using Json = nlohmann::ordered_json;

/** Null for a value that is not set. */
template <typename TValue>
Json
OptionalToJson(const std::optional<TValue> & value)
{
  return value ? Json(*value) : Json(nullptr);
}

} // end namespace medialvoxel

#endif
