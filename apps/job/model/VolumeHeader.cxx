// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeHeader.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace medialvoxel
{

std::uint64_t
VolumeGeometry::GetNumberOfVoxels() const
{
  return std::accumulate(size.begin(), size.end(), std::uint64_t{ 1 }, std::multiplies<>());
}

itk::MedialVoxelBox
VolumeGeometry::GetVoxelBox() const
{
  itk::MedialVoxelBox box{ {}, { { 1, 1, 1 } } };
  std::copy(size.begin(), size.end(), box.upper.begin());
  return box;
}

void
VolumeGeometry::SetIdentityDirection()
{
  direction.assign(size.size(), std::vector<double>(size.size(), 0.0));
  for (size_t axis = 0; axis < size.size(); ++axis)
  {
    direction[axis][axis] = 1.0;
  }
}

VolumeGeometry
GetCellGeometry(const VolumeGeometry & voxels)
{
  VolumeGeometry cells = voxels;
  for (unsigned int row = 0; row < voxels.GetDimension(); ++row)
  {
    double shift = 0.0;
    for (unsigned int axis = 0; axis < voxels.GetDimension(); ++axis)
    {
      shift += voxels.direction[axis][row] * (voxels.size[axis] > 1 ? 0.5 * voxels.spacing[axis] : 0.0);
    }
    cells.origin[row] += shift;
  }
  return cells;
}

std::string
VolumeHeader::DescribeReading() const
{
  if (chunks)
  {
    std::string shape;
    for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
    {
      shape += (axis == 0 ? "" : " x ") + std::to_string(chunks->size[geometry.GetDimension() == 2 ? 2 * axis : axis]);
    }
    return "streams: chunks of " + shape + (chunks->packing.empty() ? "" : ", packed by " + chunks->packing + ",") +
           " are read as they are needed" + (chunks->inShards ? ", each alone from its shard" : "");
  }
  if (compressed)
  {
    return "does not stream: it is compressed and unpacked once, to memory or with --scratch to the disk";
  }
  return series ? "streams: slices are decoded as they are needed" : "streams: parts are read as they are needed";
}

std::map<std::filesystem::path, std::uint64_t>
GetNeededFileSizes(const VolumeHeader & header)
{
  if (header.segments.empty())
  {
    return { { header.dataFile, header.dataOffset + header.GetDataSize() } };
  }
  std::map<std::filesystem::path, std::uint64_t> sizes;
  for (const itk::MedialVoxelFileSegment & segment : header.segments)
  {
    std::uint64_t & size = sizes[segment.fileName];
    size = std::max(size, segment.offset + segment.numberOfBytes);
  }
  return sizes;
}

} // end namespace medialvoxel
