// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandTable.h"
#include "MeshFile.h"
#include "OptionText.h"
#include "Text.h"

namespace medialvoxel
{

void
DefineCheck(CommandLine & line)
{
  const std::string formats = Join(ListMeshFileExtensions(), " ", [](const std::string & name) { return name; });
  line.check->add_option("MESH", line.checkedMesh, "Shell mesh: " + formats)
    ->type_name("FILE")
    ->required()
    ->check([](const std::string & text) { return text.empty() ? "'' is not the name of a file" : ""; });
  const auto parse = [&line](const CLI::results_t & results) {
    try
    {
      line.checkAsJson = ToFlag(results.front());
    }
    catch (const WrongValue & error)
    {
      throw CLI::ValidationError("--json", error.what());
    }
    return true;
  };
  line.check->add_option("--json", parse, "Print it as JSON")->type_name("")->type_size(1)->expected(1);
  line.examples[line.check] = { "medialvoxel check shell.inp", "medialvoxel check shell.bdf --json" };
  line.check->footer("Exits with 1 where a limit fails, with 3 where the file cannot be opened.");
}

} // end namespace medialvoxel
