// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJsonFile_h
#define medialvoxelJsonFile_h

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>

namespace medialvoxel
{

/** Reads a file that holds one value of JSON; the order of names is lost.
 * \throw JobError Failure for a file that cannot be read or is not regular, CorruptInput for one of more than
 * \a maximumBytes, 100000 values or 64 values within each other, or one that is not JSON, with the place where it goes
 * wrong. */
nlohmann::json
ReadJsonFile(const std::filesystem::path & fileName, std::uint64_t maximumBytes);

} // end namespace medialvoxel

#endif
