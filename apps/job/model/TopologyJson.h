// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTopologyJson_h
#define medialvoxelTopologyJson_h

#include "Json.h"

#include "itkMedialVoxelSameTopology.h"

namespace medialvoxel
{

inline Json
ToJson(const itk::MedialVoxelBettiNumbers & numbers)
{
  return { { "parts", numbers.parts }, { "tunnels", numbers.tunnels }, { "cavities", numbers.cavities } };
}

/** The cells that were added, and what the object and the sheet with them have, for reports. */
inline Json
DescribeTopology(const itk::MedialVoxelTopologySums & topology)
{
  return { { "added_cells", topology.addedCells },
           { "object", ToJson(topology.object) },
           { "sheet", ToJson(topology.cells) } };
}

} // end namespace medialvoxel

#endif
