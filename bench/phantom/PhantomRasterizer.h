// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef PhantomRasterizer_h
#define PhantomRasterizer_h

#include "PhantomShape.h"

namespace phantom
{
/** Surface noise: every voxel sees the surface shifted by a value of its own, uniform in [-amplitude, amplitude]. */
struct Noise
{
  double        amplitude{ 0.0 }; // voxels
  std::uint64_t seed{ 1 };
};

/** Sets mask[(z - firstSlice) * sizeX * sizeY + y * sizeX + x] to 1 inside and 0 outside.
 *  A voxel's value depends on its index alone, so neither slabs nor threads change it.
 *  \return the number of object voxels of the slab. */
std::int64_t
RasterizeSlab(const Shape &                shape,
              const Noise &                noise,
              const Size &                 size,
              std::int64_t                 firstSlice,
              std::int64_t                 numberOfSlices,
              unsigned int                 numberOfThreads,
              std::vector<unsigned char> & mask);
} // namespace phantom

#endif
