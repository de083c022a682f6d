// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelScanBlocks.h"

#include "itkMedialVoxelRandomSample.h"

#include <algorithm>
#include <cstdint>

namespace itk
{
namespace
{

using Index = MedialVoxelIndex;
using Box = MedialVoxelBox;

/** Blocks are flat, since volumes may come by whole slices. */
constexpr std::int64_t BlockSize[3] = { 256, 256, 16 };

/** Blocks that are looked at, until the samples are enough. */
constexpr std::size_t MostBlocks = 480;

/** Rows of a slice of a block that one thread looks at. */
constexpr std::int64_t RowsOfPart = 64;

} // namespace

Box
MedialVoxelGetScanBlock(const Index & voxel)
{
  Box block;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    block.lower[axis] = voxel[axis] / BlockSize[axis] * BlockSize[axis];
    block.upper[axis] = block.lower[axis] + BlockSize[axis];
  }
  return block;
}

std::vector<Box>
MedialVoxelCutScanBlocks(const std::vector<Box> & blocks)
{
  std::vector<Box> parts;
  for (const Box & block : blocks)
  {
    for (Box part = block; part.lower[1] < block.upper[1]; part.lower[1] = part.upper[1])
    {
      part.upper[1] = std::min(part.lower[1] + RowsOfPart, block.upper[1]);
      parts.push_back(part);
    }
  }
  return parts;
}

std::vector<Box>
MedialVoxelChooseScanBlocks(const Box & image)
{
  std::int64_t blocks[3];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    blocks[axis] = (image.Extent(axis) + BlockSize[axis] - 1) / BlockSize[axis];
  }
  MedialVoxelRandomSample<Box> chosen(MostBlocks);
  std::uint64_t                number = 0;
  for (std::int64_t z = 0; z < blocks[2]; ++z)
  {
    for (std::int64_t y = 0; y < blocks[1]; ++y)
    {
      for (std::int64_t x = 0; x < blocks[0]; ++x)
      {
        const Box block = MedialVoxelGetScanBlock({ { x * BlockSize[0], y * BlockSize[1], z * BlockSize[2] } });
        chosen.Add(MedialVoxelHash(number++), block.Intersection(image));
      }
    }
  }
  return chosen.Take();
}

} // end namespace itk
