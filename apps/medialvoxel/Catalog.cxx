// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandTable.h"
#include "CommandText.h"
#include "Json.h"
#include "Outputs.h"
#include "ResultViews.h"
#include "MeshFormat.h"
#include "Version.h"
#include "VolumeFormats.h"
#include "Warnings.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** Functions for arrays that have the option as a keyword. */
Json
ListFunctions(const OptionRow & row)
{
  const std::pair<unsigned int, const char *> functions[] = { { Commands::Extract, "extract" },
                                                              { Commands::Mesh, "mesh" },
                                                              { Commands::Distance, "distance" },
                                                              { Commands::Surface, "local_thickness" } };
  Json                                        names = Json::array();
  for (const auto & [command, name] : functions)
  {
    (row.python & command) != 0 ? names.push_back(name) : void();
  }
  return names;
}

Json
DescribeOption(const CommandLine & line, const CLI::Option & option)
{
  const bool                       isOptional = option.get_positional() && !option.get_required();
  const std::string                usage = GetUsage(option);
  Json                             json{ { "usage", isOptional ? "[" + usage + "]" : usage },
                                         { "group", option.get_group() },
                                         { "description", option.get_description() },
                                         { "details", GetDetails(line, option) } };
  const std::vector<std::string> & choices = GetChoices(line, option);
  if (!choices.empty())
  {
    json["choices"] = choices;
  }
  const OptionRow * const row = FindRow(line, option);
  if (!choices.empty() && row->value.initial)
  {
    json["default"] = choices.front();
  }
  if (row && row->python != 0)
  {
    json["python"] = ListFunctions(*row);
  }
  return json;
}

Json
DescribeCommand(const CommandLine & line, const CLI::App & command)
{
  Json json{ { "name", command.get_name() },
             { "description", command.get_description() },
             { "arguments", Json::array() },
             { "options", Json::array() },
             { "examples", line.examples.at(&command) } };
  for (const bool positional : { true, false })
  {
    for (const CLI::Option * const option : GetOptions(command, positional))
    {
      if (option != command.get_help_ptr() && option != command.get_help_all_ptr())
      {
        json[positional ? "arguments" : "options"].push_back(DescribeOption(line, *option));
      }
    }
  }
  return json;
}

bool
Contains(const std::vector<std::string> & texts, const std::string & text)
{
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

Json
DescribeVolumeFormats()
{
  Json                           json = Json::array();
  constexpr unsigned int         vector = 3;
  const std::vector<std::string> written = ListOutputExtensions();
  const std::vector<std::string> ofVectors = ListOutputExtensions(vector);
  for (const std::string & extension : ListInputExtensions())
  {
    const std::string fileName = "a" + extension;
    const bool        isWritten = Contains(written, extension);
    json.push_back({ { "extension", extension },
                     { "format", FindInputFormat(fileName).name },
                     { "written", isWritten },
                     { "vectors", Contains(ofVectors, extension) },
                     { "always_packed", isWritten && IsPackedVolume(fileName, Compression::Default) },
                     { "packed_on_request", isWritten && IsPackedVolume(fileName, Compression::On) } });
  }
  return json;
}

template <typename TOptions>
Json
DescribeOutputs()
{
  VolumeHeader volume;
  volume.geometry.size = { 1, 1, 1 };
  Json json = Json::array();
  for (const OutputKind<TOptions> & kind : ListOutputKinds(TOptions{}))
  {
    Json output{ { "role", kind.role }, { "extensions", kind.extensions } };
    if (kind.volume)
    {
      const VoxelLayout layout = kind.volume->getLayout(volume);
      output["type"] = GetTraits(layout.pixelType).name;
      output["components"] = layout.components;
      output["grid"] = kind.volume->isOfCells ? "cells" : "voxels";
    }
    output["in_jobs"] = !kind.refusal;
    json.push_back(output);
  }
  return json;
}

/** The rows of tables, with their paths in the report. */
Json
DescribeViews()
{
  Json json = Json::array();
  for (const ViewRow & row : ListViewRows())
  {
    json.push_back(
      { { "condition", row.condition }, { "name", row.name }, { "value", row.value }, { "list", row.list } });
  }
  return json;
}

} // namespace

std::string
MakeCatalog(const CommandLine & line, const CLI::App & app)
{
  Json json{ { "version", GetVersion() }, { "notes", app.get_footer() }, { "commands", Json::array() } };
  for (const CLI::App * const command : GetCommands(app))
  {
    json["commands"].push_back(DescribeCommand(line, *command));
  }
  json["volume_formats"] = DescribeVolumeFormats();
  json["mesh_formats"] = ListMeshExtensions();
  json["outputs"] = { { "extract", DescribeOutputs<ExtractOptions>() },
                      { "surface", DescribeOutputs<PartOptions>() },
                      { "distance", DescribeOutputs<DistanceOptions>() } };
  json["warnings"] = ListWarningCodes();
  json["views"] = DescribeViews();
  return json.dump(2) + "\n";
}

} // end namespace medialvoxel
