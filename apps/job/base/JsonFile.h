// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJsonFile_h
#define medialvoxelJsonFile_h

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace medialvoxel
{

/** Reads a file.
 * \throw JobError Failure for one that cannot be read or is not regular, CorruptInput for one of more than
 * \a maximumSize. */
std::string
ReadTextFile(const std::filesystem::path & fileName, std::uint64_t maximumSize);

/** Reads a file that holds one value of JSON; the order of names is lost.
 * \throw JobError as ReadTextFile(), and CorruptInput for one of 100000 values or 64 values within each other, or one
 * that is not JSON, with the place where it goes wrong. */
nlohmann::json
ReadJsonFile(const std::filesystem::path & fileName, std::uint64_t maximumSize);

} // end namespace medialvoxel

#endif
