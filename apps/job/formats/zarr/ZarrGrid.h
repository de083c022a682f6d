// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrGrid_h
#define medialvoxelZarrGrid_h

#include "JobPlan.h"
#include "VoxelLayout.h"

#include <array>
#include <cstdint>
#include <string>

namespace medialvoxel
{

/** Indices or sizes along x, y and the slices. */
using ZarrIndex = std::array<std::uint64_t, 3>;

/** A part of a volume. */
struct ZarrBox
{
  ZarrIndex begin{ { 0, 0, 0 } };
  ZarrIndex size{ { 0, 0, 0 } };
};

/** \class ZarrGrid
 * \brief How a volume is cut into the chunks of a Zarr array.
 *
 * Slices are indices along the last axis; an image of two dimensions has one row in each. Components have chunks of
 * their own. All chunks have the same size: chunks at the end of an axis go beyond the volume. */
struct ZarrGrid
{
  ZarrIndex    size{ { 1, 1, 1 } };
  ZarrIndex    chunk{ { 1, 1, 1 } };
  VoxelLayout  layout;
  unsigned int dimension{ 3 };
  unsigned int leadingAxes{ 0 }; ///< of the array, before the axes of space; the last of them is the axis of components
  char         separator{ '/' }; ///< between the indices in the name of a chunk
  std::string  prefix;           ///< of that name

  /** Chunks of 32 x 256 x 256 voxels, or 1024 x 1024 pixels, made smaller where that leaves less of them outside. The
   * shape depends on the volume alone, so that files have the same bytes however the work is divided. */
  static ZarrGrid
  ForVolume(const VolumeGeometry & geometry, const VoxelLayout & layout);

  std::uint64_t
  GetNumberOfChunks(unsigned int axis) const
  {
    return (size[axis] + chunk[axis] - 1) / chunk[axis];
  }

  /** Chunks of all components that a layer, a range of chunk[2] slices, has. */
  std::uint64_t
  GetChunksPerLayer() const
  {
    return layout.components * GetNumberOfChunks(0) * GetNumberOfChunks(1);
  }

  std::uint64_t
  GetNumberOfAllChunks() const
  {
    return GetChunksPerLayer() * GetNumberOfChunks(2);
  }

  /** Bytes of one slice of a chunk. */
  std::uint64_t
  GetPlaneSize() const
  {
    return chunk[0] * chunk[1] * GetTraits(layout.pixelType).bytes;
  }

  std::uint64_t
  GetChunkSize() const
  {
    return GetPlaneSize() * chunk[2];
  }

  /** Name in the folder of the array. \param index of the chunk, not of a voxel */
  std::string
  GetChunkName(std::uint64_t component, const ZarrIndex & index) const;

  /** The part of the volume that is in a chunk. */
  ZarrBox
  GetBox(const ZarrIndex & index) const;
};

/** Voxels that two boxes share; of size 0 along each axis without any. */
ZarrBox
Intersect(const ZarrBox & a, const ZarrBox & b);

/** Calls function(component, index) for the chunks that have voxels of \a box, which is not empty. */
template <typename TFunction>
void
ForEachChunk(const ZarrGrid & grid, const ZarrBox & box, TFunction && function)
{
  const auto first = [&](unsigned int axis) { return box.begin[axis] / grid.chunk[axis]; };
  const auto last = [&](unsigned int axis) { return (box.begin[axis] + box.size[axis] - 1) / grid.chunk[axis]; };
  for (std::uint64_t component = 0; component < grid.layout.components; ++component)
  {
    for (std::uint64_t z = first(2); z <= last(2); ++z)
    {
      for (std::uint64_t y = first(1); y <= last(1); ++y)
      {
        for (std::uint64_t x = first(0); x <= last(0); ++x)
        {
          function(component, ZarrIndex{ { x, y, z } });
        }
      }
    }
  }
}

/** Fills slices of a chunk from a stretch of slices of the volume, all components of a voxel together, x fastest;
 * zeros where the chunk goes beyond the rows and columns of the volume.
 * \param rows of each slice that the voxels have, including the rows of the chunk
 * \param voxels begin with the first of the slices
 * \param planes receive as many slices of the chunk */
void
GatherSlices(const ZarrGrid & grid,
             std::uint64_t    component,
             std::uint64_t    chunkX,
             std::uint64_t    chunkY,
             std::uint64_t    numberOfSlices,
             const RowRange & rows,
             const void *     voxels,
             void *           planes);

/** Copies the part of a chunk to a box of voxels.
 * \param part a box in \a box and in the chunk
 * \param planes slices of the chunk from the first slice of \a part on */
void
ScatterSlices(const ZarrGrid &  grid,
              std::uint64_t     component,
              const ZarrIndex & index,
              const ZarrBox &   part,
              const void *      planes,
              const ZarrBox &   box,
              void *            voxels);

} // end namespace medialvoxel

#endif
