// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzArguments_h
#define FuzzArguments_h

#include "CommandLine.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace MedialVoxelFuzz
{

/** The lines of an input. */
std::vector<std::string>
SplitIntoLines(const std::uint8_t * data, std::size_t size);

/** What the program takes from arguments, until the next call; nothing for what it refuses, and for calls of help and
 * version. */
const medialvoxel::CommandLine *
ParseArguments(std::vector<std::string> arguments);

} // namespace MedialVoxelFuzz

#endif
