// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelNiftiFields_h
#define medialvoxelNiftiFields_h

#include "PixelType.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace medialvoxel
{

/** The headers of NIfTI files, of version 1 and of version 2. */
namespace NiftiFields
{

/** Fields whose kind differs between both versions. */
struct Version
{
  std::int32_t     headerSize; ///< also the value of the first field
  double           minimumDataOffset;
  std::size_t      magic; ///< where it lies
  std::string_view magicOfFile;
  std::string_view magicOfPair; ///< of a header whose voxels are in a file of their own
};

inline constexpr std::array<Version, 2> Versions{
  { { 348, 352, 344, { "n+1\0", 4 }, { "ni1\0", 4 } },
    { 540, 544, 4, { "n+2\0\r\n\x1a\n", 8 }, { "ni2\0\r\n\x1a\n", 8 } } }
};

enum class Number : std::uint8_t
{
  UInt8,
  Int16,
  Int32,
  Int64,
  Float32,
  Float64
};

struct Place
{
  std::size_t offset;
  Number      type;
};

/** Where a field, or the first of several that follow each other, lies in each version. */
using Field = std::array<Place, 2>;

inline constexpr Field SizeOfHeader{ { { 0, Number::Int32 }, { 0, Number::Int32 } } };
inline constexpr Field Dim{ { { 40, Number::Int16 }, { 16, Number::Int64 } } };
inline constexpr Field DataType{ { { 70, Number::Int16 }, { 12, Number::Int16 } } };
inline constexpr Field BitsPerVoxel{ { { 72, Number::Int16 }, { 14, Number::Int16 } } };
inline constexpr Field PixDim{ { { 76, Number::Float32 }, { 104, Number::Float64 } } };
inline constexpr Field VoxelOffset{ { { 108, Number::Float32 }, { 168, Number::Int64 } } };
inline constexpr Field ScaleSlope{ { { 112, Number::Float32 }, { 176, Number::Float64 } } };
inline constexpr Field ScaleIntercept{ { { 116, Number::Float32 }, { 184, Number::Float64 } } };
inline constexpr Field Units{ { { 123, Number::UInt8 }, { 500, Number::Int32 } } };
inline constexpr Field QFormCode{ { { 252, Number::Int16 }, { 344, Number::Int32 } } };
inline constexpr Field SFormCode{ { { 254, Number::Int16 }, { 348, Number::Int32 } } };
inline constexpr Field Quaternion{ { { 256, Number::Float32 }, { 352, Number::Float64 } } };
inline constexpr Field QOffset{ { { 268, Number::Float32 }, { 376, Number::Float64 } } };
inline constexpr Field SRows{ { { 280, Number::Float32 }, { 400, Number::Float64 } } };

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

/** Calls function(T{}) with the C++ type of a number. */
template <typename TFunction>
auto
DispatchNumber(Number type, TFunction && function)
{
  switch (type)
  {
    case Number::UInt8:
      return function(std::uint8_t{});
    case Number::Int16:
      return function(std::int16_t{});
    case Number::Int32:
      return function(std::int32_t{});
    case Number::Int64:
      return function(std::int64_t{});
    case Number::Float32:
      return function(float{});
    default:
      return function(double{});
  }
}

} // end namespace NiftiFields
} // end namespace medialvoxel

#endif
