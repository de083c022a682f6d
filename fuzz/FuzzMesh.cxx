// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The reader of meshes of the format of FUZZ_FILE_NAME, and the check of what it reads.

#include "Errors.h"
#include "FuzzSupport.h"
#include "MeshCheck.h"

namespace
{

using namespace medialvoxel;

/** All that is counted is there. */
void
CheckNumbers(const MeshFile & mesh)
{
  const MeshCheck check = CheckMesh(mesh);
  MedialVoxelFuzz::Require(check.triangles + check.quads == mesh.elements.size() && check.nodes <= mesh.points.size() &&
                             check.sameNodes <= check.nodes && check.shapes.notPositive <= mesh.elements.size() &&
                             check.walls <= mesh.elements.size(),
                           "numbers that do not fit");
  MakeMeshCheckJson("mesh", check);
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const MedialVoxelFuzz::InputFile file(FUZZ_FILE_NAME);
  file.Write(data, size);
  try
  {
    CheckNumbers(ReadMeshFile(file.GetPath().string()));
  }
  catch (const JobError & error)
  {
    file.RequireClearError(error.what());
  }
  return 0;
}
