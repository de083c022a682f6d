// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandWords_h
#define medialvoxelCommandWords_h

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace medialvoxel
{

/** The command that the words begin with; null when they begin with none. */
const CLI::App *
FindCommand(const CLI::App & app, const std::vector<std::string> & words);

/** Parses words in one form: each option once, flags too, with its value as the next word. The parser never has to
 * read values of flags, an empty value behind an equals sign, or an option in place of a value.
 * \throw CLI::ValidationError for an option that is given twice, or lacks its value
 * \throw CLI::ParseError as the parser */
void
ParseWords(CLI::App & app, std::vector<std::string> words);

} // end namespace medialvoxel

#endif
