// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheet_h
#define itkMedialVoxelSheet_h

#include "itkMedialVoxelVector3.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** A finished surface of triangles, in memory. */
struct MedialVoxelSheet
{
  using Index = std::uint32_t;

  std::vector<MedialVoxelVector3>   points;
  std::vector<float>                thickness; ///< of the wall at each point; not above 0 or not finite: unknown
  std::vector<std::array<Index, 3>> triangles; ///< no two with the same points

  /** Both halves of a quadrilateral along its shorter diagonal, that from the first corner where both are equal. */
  void
  AddQuad(const std::array<Index, 4> & corners);

  /** Leaves out triangles that come again. */
  void
  RemoveDuplicates();
};

inline bool
MedialVoxelIsKnown(const float thickness)
{
  return thickness > 0.0F && std::isfinite(thickness);
}

} // end namespace itk

#endif
