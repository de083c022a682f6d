// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandParts.h"
#include "MeshFile.h"
#include "OptionValues.h"
#include "Text.h"

namespace medialvoxel
{

void
DefineCheck(CommandLine & line)
{
  const std::string formats = Join(ListMeshFileExtensions(), " ", [](const std::string & name) { return name; });
  AddFile(*line.check, "MESH", "Shell mesh: " + formats, line.checkedMesh)->required();
  AddFlag(*line.check, "--json", "Print it as JSON", line.checkAsJson);
  line.examples[line.check] = { "medialvoxel check shell.inp", "medialvoxel check shell.bdf --json" };
  line.check->footer("Exits with 1 where a limit fails, with 3 where the file cannot be opened.");
}

} // end namespace medialvoxel
