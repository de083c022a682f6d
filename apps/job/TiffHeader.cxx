// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "TiffStack.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** Where uncompressed voxels lie; strips that follow each other are one stretch. */
std::vector<itk::MedialVoxelFileSegment>
LocateVoxels(const TiffStack & stack)
{
  std::vector<itk::MedialVoxelFileSegment> segments;
  for (const TiffStrip & strip : stack.strips)
  {
    if (!segments.empty() && segments.back().offset + segments.back().numberOfBytes == strip.offset)
    {
      segments.back().numberOfBytes += strip.bytes;
    }
    else
    {
      segments.push_back({ stack.fileName, strip.offset, strip.bytes });
    }
  }
  return segments;
}

/** The largest strip, packed and unpacked, and the table of all strips. */
std::uint64_t
GetUnpackBytes(const TiffStack & stack)
{
  std::uint64_t bytes = 0;
  for (const TiffStrip & strip : stack.strips)
  {
    bytes = std::max(bytes, strip.packedBytes + strip.bytes);
  }
  return bytes + stack.strips.size() * sizeof(TiffStrip);
}

} // namespace

VolumeHeader
ReadTiffHeader(const std::filesystem::path & fileName)
{
  const TiffStack stack = ReadTiffStack(fileName);
  VolumeHeader    header;
  header.fileName = fileName;
  header.format = TiffFormat;
  header.geometry.size = { stack.width, stack.height };
  header.geometry.spacing = { stack.spacingX, stack.spacingY };
  if (stack.numberOfSlices > 1)
  {
    // The format has no distance of slices.
    header.geometry.size.push_back(stack.numberOfSlices);
    header.geometry.spacing.push_back(1.0);
  }
  header.geometry.origin.assign(header.geometry.size.size(), 0.0);
  header.geometry.SetIdentityDirection();
  header.pixelType = stack.pixelType;
  header.bigEndian = stack.bigEndian;
  header.dataFile = fileName;
  header.dataFileSize = GetDataFileSize(fileName, fileName);
  header.dataOffset = stack.strips.front().offset;
  header.compressed = stack.compression != TiffCompression::None;
  if (header.compressed)
  {
    header.unpackBytes = GetUnpackBytes(stack);
  }
  else
  {
    header.segments = LocateVoxels(stack);
  }
  return header;
}

} // end namespace medialvoxel
