// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshPlacement.h"

#include "Errors.h"
#include "FileNames.h"
#include "MeshFormat.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{

itk::MedialVoxelIndex
GetSize(const VolumeGeometry & geometry)
{
  return { { static_cast<std::int64_t>(geometry.size[0]),
             static_cast<std::int64_t>(geometry.size[1]),
             static_cast<std::int64_t>(geometry.size[2]) } };
}

itk::MedialVoxelSurfacePlacement
GetPlacement(const VolumeGeometry & geometry)
{
  itk::MedialVoxelSurfacePlacement placement;
  for (unsigned int component = 0; component < 3; ++component)
  {
    placement.origin[component] = geometry.origin[component];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      placement.steps[axis][component] = geometry.direction[axis][component] * geometry.spacing[axis];
    }
  }
  return placement;
}

MeshPrecision
GetPrecision(const VolumeGeometry & geometry)
{
  return GetPlacement(geometry).FitsFloat(GetSize(geometry)) ? MeshPrecision::Single : MeshPrecision::Double;
}

std::filesystem::path
GetScratchFolder(const JobOptions & options, const std::string & surfaceFile)
{
  if (!options.scratchFolder.empty())
  {
    return options.scratchFolder;
  }
  const std::filesystem::path folder = FollowLinks(surfaceFile).parent_path();
  return folder.empty() ? "." : folder;
}

void
CheckDimension(const VolumeHeader & header, const char * kind)
{
  if (header.geometry.GetDimension() != 3)
  {
    Fail(ExitStatus::Usage, header.fileName, ": the volume has 2 dimensions; a ", kind, " needs 3");
  }
}

void
CheckMeshInput(const VolumeHeader & header, const std::string & surfaceFile, const char * kind)
{
  CheckDimension(header, kind);
  if (!HoldsDouble(GetMeshFormat(surfaceFile)) && GetPrecision(header.geometry) == MeshPrecision::Double)
  {
    const auto & spacing = header.geometry.spacing;
    const double largest = GetPlacement(header.geometry).LargestCoordinate(GetSize(header.geometry));
    Fail(ExitStatus::Usage,
         surfaceFile,
         ": coordinates of ",
         header.fileName,
         " reach ",
         FormatNumber(largest),
         " with a spacing of ",
         FormatNumber(*std::min_element(spacing.begin(), spacing.end())),
         "; this format has 32 bits for each, which do not keep neighboring vertices apart; other formats have 64");
  }
}

} // end namespace medialvoxel
