// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSealedJson_h
#define medialvoxelSealedJson_h

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

using Json = nlohmann::ordered_json;

/** Writes a file that is complete and on the disk when it appears, in place of one that is there.
 * \throw JobError Failure */
void
WriteDurably(const std::filesystem::path & fileName, const std::string & text);

/** Writes a JSON object with the checksum of all else as its last member, as WriteDurably().
 * \throw JobError Usage when a text in it is not valid UTF-8 */
void
WriteSealed(const std::filesystem::path & fileName, Json object);

/** The object of a file of WriteSealed(), without the checksum; nothing when there is no such file.
 * \throw JobError Failure for a file that cannot be read, is damaged or was changed */
std::optional<Json>
ReadSealed(const std::filesystem::path & fileName);

/** Numbers of JSON are finite; others become text. */
Json
NumberToJson(const std::optional<double> & value);
std::optional<double>
NumberFromJson(const Json & value);

} // end namespace medialvoxel

#endif
