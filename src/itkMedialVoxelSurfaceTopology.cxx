// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurfaceTopology.h"

namespace itk
{

MedialVoxelIndex
MedialVoxelSurfaceTopology::OffsetOf(const unsigned int edge)
{
  const unsigned int axis = AxisOf(edge);
  MedialVoxelIndex   offset{ { 0, 0, 0 } };
  offset[(axis + 1) % 3] = edge & 1;
  offset[(axis + 2) % 3] = (edge >> 1) & 1;
  return offset;
}

std::uint8_t
MedialVoxelSurfaceTopology::DirectionsToFollow(const EdgeMask quads)
{
  unsigned int joined = 0;
  unsigned int rim = 0;
  unsigned int junction = 0;
  for (unsigned int direction = 0; direction < NumberOfDirections; ++direction)
  {
    const unsigned int number = QuadsTowards(quads, direction);
    joined |= (number > 0 ? 1u : 0u) << direction;
    rim |= (number == 1 ? 1u : 0u) << direction;
    junction |= (number > 2 ? 1u : 0u) << direction;
  }
  if (rim != 0 && junction != 0)
  {
    return 0;
  }
  return static_cast<std::uint8_t>(rim != 0 ? rim : (junction != 0 ? junction : joined));
}

} // end namespace itk
