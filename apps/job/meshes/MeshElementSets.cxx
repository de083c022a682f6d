// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshElementSets.h"

#include <algorithm>

namespace medialvoxel
{

MeshElementSets::MeshElementSets(const std::vector<std::uint64_t> & sizes, const std::uint64_t keptElements)
{
  std::uint64_t kept = 0;
  for (std::size_t group = 0; group < sizes.size(); ++group)
  {
    kept += sizes[group];
    if (group > 0 && kept > keptElements)
    {
      m_Ends.push_back(group);
      kept = sizes[group];
    }
  }
  if (!sizes.empty())
  {
    m_Ends.push_back(sizes.size());
  }
}

std::vector<std::uint64_t>
CountElementsOfWalls(MeshReader & reader, const MeshWriteOptions & options)
{
  std::vector<std::uint64_t> sizes;
  if (options.hasWalls)
  {
    ForEachElement(reader, [&](std::uint64_t, const MeshFace & face, const MeshCorners &) {
      sizes.resize(std::max<std::size_t>(sizes.size(), face.wall));
      if (face.wall > 0)
      {
        ++sizes[GetWallGroup(face)];
      }
    });
  }
  return sizes;
}

} // end namespace medialvoxel
