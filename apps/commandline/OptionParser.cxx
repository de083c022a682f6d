// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionParser.h"

namespace medialvoxel
{

CLI::Option *
AddOption(CLI::App &           app,
          const std::string &  name,
          const std::string &  unit,
          const std::string &  help,
          const OptionValue &  value,
          const OptionTarget & target)
{
  const auto parse = [name, value, target](const CLI::results_t & results) {
    try
    {
      // How long a voxel is, is known when the volume is.
      if (!value.isLength || !HasVoxels(results.front()))
      {
        value.set(target, value.isLength ? ReplaceUnits(results.front(), 1.0) : results.front());
      }
    }
    catch (const WrongValue & error)
    {
      throw CLI::ValidationError(name, error.what());
    }
    return true;
  };
  return app.add_option(name, parse, help)->type_name(unit)->type_size(1)->expected(1);
}

bool
HasValue(const CLI::Option & option)
{
  return option.get_items_expected_max() > 0 && !option.get_type_name().empty();
}

} // end namespace medialvoxel
