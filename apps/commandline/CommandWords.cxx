// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandWords.h"

#include "OptionParser.h"

#include <algorithm>
#include <set>
#include <utility>

namespace medialvoxel
{
namespace
{

/** The option that a word names, with or without a value behind an equals sign; null when it names none. */
const CLI::Option *
FindOption(const CLI::App & command, const std::string & word)
{
  return word.compare(0, 2, "--") == 0 ? command.get_option_no_throw(word.substr(0, word.find('='))) : nullptr;
}

/** Whether a word is the value of the flag before it. 0 and 1 are not: files have these names. */
bool
IsWordOfFlag(const std::string & word, const std::vector<std::string> & names)
{
  const bool isName = std::find(names.begin(), names.end(), ToLower(word)) != names.end();
  return isName || (word != "0" && word != "1" && ParseFlag(word));
}

std::vector<std::string>
CompleteWords(const CLI::App & command, const std::vector<std::string> & words, const WordsOfFlag & wordsOfFlag)
{
  std::vector<std::string>      complete;
  std::set<const CLI::Option *> given;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    const std::string & word = words[i];
    if (word == "--")
    {
      complete.insert(complete.end(), words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
      break;
    }
    const CLI::Option * const option = FindOption(command, word);
    const std::size_t         sign = word.find('=');
    const std::string         name = word.substr(0, sign);
    if (option == nullptr)
    {
      complete.push_back(word); // an argument, or refused by the parser
      continue;
    }
    complete.push_back(name);
    const bool hasSign = sign != std::string::npos;
    const bool hasNext = i + 1 < words.size();
    const auto names = wordsOfFlag ? wordsOfFlag(*option) : std::vector<std::string>();
    if (option->get_items_expected_max() == 0) // help and version, which end the program
    {
      if (hasSign)
      {
        throw CLI::ValidationError(name, "'" + word.substr(sign + 1) + "' is a value; it takes none");
      }
      continue;
    }
    if (hasSign)
    {
      complete.push_back(word.substr(sign + 1));
    }
    else if (!HasValue(*option) || !names.empty())
    {
      complete.push_back(hasNext && IsWordOfFlag(words[i + 1], names) ? words[++i] : "true");
    }
    else if (!hasNext || FindOption(command, words[i + 1]) != nullptr)
    {
      throw CLI::ValidationError(name,
                                 "has no value, " + option->get_type_name() +
                                   (hasNext ? "; the option " + words[i + 1] + " follows" : ""));
    }
    else
    {
      complete.push_back(words[++i]);
    }
    if (!given.insert(option).second)
    {
      throw CLI::ValidationError(name, "is given twice, now as '" + complete.back() + "'; it must be given once");
    }
  }
  return complete;
}

} // namespace

const CLI::App *
FindCommand(const CLI::App & app, const std::vector<std::string> & words)
{
  for (const CLI::App * const command : app.get_subcommands({}))
  {
    if (!words.empty() && command->get_name() == words.front())
    {
      return command;
    }
  }
  return nullptr;
}

void
ParseWords(CLI::App & app, std::vector<std::string> words, const WordsOfFlag & wordsOfFlag)
{
  const CLI::App * const   command = FindCommand(app, words);
  std::vector<std::string> reversed;
  if (command != nullptr)
  {
    reversed.push_back(words.front());
    words.erase(words.begin());
  }
  words = CompleteWords(command != nullptr ? *command : app, words, wordsOfFlag);
  reversed.insert(reversed.end(), words.begin(), words.end());
  std::reverse(reversed.begin(), reversed.end());
  app.parse(std::move(reversed));
}

} // end namespace medialvoxel
