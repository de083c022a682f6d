// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FuzzArguments.h"

#include "FuzzSupport.h"

#include <sstream>

namespace MedialVoxelFuzz
{

std::vector<std::string>
SplitIntoLines(const std::uint8_t * data, std::size_t size)
{
  std::istringstream       text(std::string(reinterpret_cast<const char *>(data), size));
  std::vector<std::string> lines;
  std::string              line;
  while (std::getline(text, line))
  {
    lines.push_back(line);
  }
  return lines;
}

const medialvoxel::CommandLine *
ParseArguments(std::vector<std::string> arguments)
{
  // Defining the commands takes a hundred times as long as parsing.
  static medialvoxel::CommandLine       line;
  static const auto                     app = medialvoxel::DefineCommandLine(line);
  static const medialvoxel::CommandLine unparsed = line;
  line = unparsed;
  std::vector<const char *> pointers{ "medialvoxel" };
  for (std::string & argument : arguments)
  {
    // The system ends arguments at a zero byte.
    argument = argument.c_str();
    pointers.push_back(argument.c_str());
  }
  try
  {
    app->parse(static_cast<int>(pointers.size()), const_cast<char **>(pointers.data()));
    return &line;
  }
  catch (const CLI::ParseError & error)
  {
    std::ostringstream out;
    std::ostringstream messages;
    app->exit(error, out, messages);
    Require(!out.str().empty() || !messages.str().empty(), "an end of the parsing without a word");
    return nullptr;
  }
}

} // namespace MedialVoxelFuzz
