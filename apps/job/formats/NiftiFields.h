// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelNiftiFields_h
#define medialvoxelNiftiFields_h

#include "PixelType.h"

#include <array>
#include <cstdint>
#include <utility>

namespace medialvoxel
{

/** The header of NIfTI-1 files. */
namespace NiftiFields
{

inline constexpr std::int32_t HeaderBytes = 348;
inline constexpr double       MinimumDataOffset = 352;

/** Offsets of the fields that are used. */
enum Field : std::size_t
{
  SizeOfHeader = 0,
  Dim = 40,
  DataType = 70,
  BitsPerVoxel = 72,
  PixDim = 76,
  VoxelOffset = 108,
  ScaleSlope = 112,
  ScaleIntercept = 116,
  Units = 123,
  QFormCode = 252,
  SFormCode = 254,
  Quaternion = 256,
  QOffset = 268,
  SRows = 280,
  Magic = 344
};

inline constexpr std::array<std::pair<std::int16_t, PixelType>, 10> DataTypes{ { { 2, PixelType::UInt8 },
                                                                                 { 4, PixelType::Int16 },
                                                                                 { 8, PixelType::Int32 },
                                                                                 { 16, PixelType::Float32 },
                                                                                 { 64, PixelType::Float64 },
                                                                                 { 256, PixelType::Int8 },
                                                                                 { 512, PixelType::UInt16 },
                                                                                 { 768, PixelType::UInt32 },
                                                                                 { 1024, PixelType::Int64 },
                                                                                 { 1280, PixelType::UInt64 } } };

} // end namespace NiftiFields
} // end namespace medialvoxel

#endif
