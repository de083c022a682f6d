// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandParts.h"
#include "MeshFile.h"
#include "Text.h"

namespace medialvoxel
{

void
DefineCheck(CommandLine & line)
{
  const std::string formats = Join(ListMeshFileExtensions(), " ", [](const std::string & name) { return name; });
  line.check->add_option("MESH", line.checkedMesh, "Shell mesh: " + formats)->type_name("FILE")->required();
  line.check->add_flag("--json", line.checkAsJson, "Print it as JSON");
  line.examples[line.check] = { "medialvoxel check shell.inp", "medialvoxel check shell.bdf --json" };
  line.check->footer("Exits with 1 where a limit does not hold.");
}

} // end namespace medialvoxel
