// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRows_h
#define itkMedialVoxelRows_h

#include "itkMedialVoxelGrid.h"

#include <array>
#include <cstdint>

namespace itk
{

/** Voxels of a buffer from one voxel to the next along each axis; 1 along x. */
using MedialVoxelStrides = std::array<std::int64_t, 3>;

/** \brief Call \a function(offset, row) for each row of \a box.
 *
 * \a offset counts voxels of a buffer with \a strides from the first voxel of \a box to that of the row.
 * \ingroup MedialVoxel
 */
template <typename TFunction>
void
MedialVoxelForEachRow(const MedialVoxelBox & box, const MedialVoxelStrides & strides, TFunction && function)
{
  MedialVoxelBox row = box;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    row.lower[2] = z;
    row.upper[2] = z + 1;
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      row.lower[1] = y;
      row.upper[1] = y + 1;
      function((z - box.lower[2]) * strides[2] + (y - box.lower[1]) * strides[1], row);
    }
  }
}

} // end namespace itk

#endif
