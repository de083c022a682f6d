// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCommandWords_h
#define medialvoxelCommandWords_h

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** The command that the words begin with; null when they begin with none. */
const CLI::App *
FindCommand(const CLI::App & app, const std::vector<std::string> & words);

/** Names that an option takes as its value; it is on without one. Empty for other options. */
using WordsOfFlag = std::function<std::vector<std::string>(const CLI::Option &)>;

/** Parses words in one form: each option once, flags too, with its value as the next word. The parser never has to
 * read values of flags, an empty value behind an equals sign, or an option in place of a value.
 * \param wordsOfFlag none: flags are on or off
 * \throw CLI::ValidationError for an option that is given twice, or lacks its value
 * \throw CLI::ParseError as the parser */
void
ParseWords(CLI::App & app, std::vector<std::string> words, const WordsOfFlag & wordsOfFlag = {});

} // end namespace medialvoxel

#endif
