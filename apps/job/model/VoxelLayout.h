// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVoxelLayout_h
#define medialvoxelVoxelLayout_h

#include "VolumeHeader.h"

#include <cstdint>

namespace medialvoxel
{

class SegmentTable;

/** The voxels of an output: \a components values of one type each. */
struct VoxelLayout
{
  PixelType    pixelType{ PixelType::UInt8 };
  unsigned int components{ 1 };

  /** Names of labels, for formats that have names. Must outlive the volume. */
  const SegmentTable * segments{ nullptr };

  std::uint64_t
  GetBytes() const
  {
    return std::uint64_t{ GetTraits(pixelType).bytes } * components;
  }
};

/** Float32 vectors with as many components as the volume has dimensions. */
inline VoxelLayout
GetVectorLayout(const VolumeHeader & header)
{
  return { PixelType::Float32, header.geometry.GetDimension() };
}

inline constexpr VoxelLayout LabelLayout{ PixelType::UInt8, 1 };
inline constexpr VoxelLayout DistanceLayout{ PixelType::Float32, 1 };
inline constexpr VoxelLayout WallLayout{ PixelType::UInt32, 1 };
inline constexpr VoxelLayout ThicknessLayout{ PixelType::Float32, 1 };

} // end namespace medialvoxel

#endif
