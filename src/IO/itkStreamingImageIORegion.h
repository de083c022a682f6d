// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkStreamingImageIORegion_h
#define itkStreamingImageIORegion_h

#include "itkImageIOBase.h"
#include "itkMedialVoxelFileRegion.h"

namespace itk
{

/** Where the region set by SetIORegion() lies in the file; axes that the region lacks have the index 0. */
inline MedialVoxelFileRegion
MakeFileRegion(const ImageIOBase & io)
{
  const ImageIORegion &      region = io.GetIORegion();
  std::vector<std::uint64_t> size;
  std::vector<std::uint64_t> index;
  std::vector<std::uint64_t> extent;
  for (unsigned int axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
  {
    const bool inRegion = axis < region.GetImageDimension();
    size.push_back(io.GetDimensions(axis));
    index.push_back(inRegion ? static_cast<std::uint64_t>(region.GetIndex(axis)) : 0);
    extent.push_back(inRegion ? region.GetSize(axis) : 1);
  }
  return { size, index, extent, std::uint64_t{ io.GetComponentSize() } * io.GetNumberOfComponents() };
}

} // end namespace itk

#endif
