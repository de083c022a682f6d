// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionParser.h"

#include "Errors.h"
#include "ReadVolumeHeader.h"

#include <algorithm>

namespace medialvoxel
{

std::unique_ptr<CLI::App>
MakeParser(const std::string & help, const std::string & programName)
{
  auto parser = std::make_unique<CLI::App>(help, programName);
  // On Windows, too, a name of a file may begin with a slash.
  parser->allow_windows_style_options(false);
  return parser;
}

CLI::Option *
AddOption(CLI::App &           app,
          const std::string &  name,
          const std::string &  unit,
          const std::string &  help,
          const OptionValue &  value,
          const OptionTarget & target)
{
  const auto parse = [name, value, target](const CLI::results_t & results) {
    const auto set = [name, value, target, text = results.front()](double voxel) {
      try
      {
        value.set(target, value.isLength ? ReplaceUnits(text, voxel) : text);
      }
      catch (const WrongValue & error)
      {
        throw CLI::ValidationError(name, error.what());
      }
    };
    // How long a voxel is, is known when the volume is.
    const bool waits = value.isLength && HasVoxels(results.front());
    waits ? std::get<ProgramOptions *>(target)->lengthsInVoxels.push_back(set) : set(1.0);
    return true;
  };
  return app.add_option(name, parse, help)->type_name(unit)->type_size(1)->expected(1);
}

void
SetLengthsInVoxels(const ProgramOptions & program, const JobOptions & options, bool hasSheets)
{
  if (program.lengthsInVoxels.empty())
  {
    return;
  }
  const VolumeHeader          header = hasSheets ? ReadSheetInputHeader(options) : ReadInputHeader(options);
  const std::vector<double> & spacing = header.geometry.spacing;
  const double                voxel = *std::min_element(spacing.begin(), spacing.end());
  try
  {
    for (const auto & set : program.lengthsInVoxels)
    {
      set(voxel);
    }
  }
  catch (const CLI::ParseError & error)
  {
    Fail(ExitStatus::Usage, error.what());
  }
}

bool
HasValue(const CLI::Option & option)
{
  return option.get_items_expected_max() > 0 && !option.get_type_name().empty();
}

} // end namespace medialvoxel
