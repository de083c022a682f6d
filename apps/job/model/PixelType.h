// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPixelType_h
#define medialvoxelPixelType_h

#include "Errors.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace medialvoxel
{

/** Types of voxel values that are read. */
enum class PixelType : std::uint8_t
{
  UInt8,
  Int8,
  UInt16,
  Int16,
  UInt32,
  Int32,
  UInt64,
  Int64,
  Float32,
  Float64
};

/** Names of a type in the program and in MetaImage headers, and its size. */
struct PixelTypeTraits
{
  PixelType        type;
  std::string_view name;
  std::string_view metaName;
  unsigned int     bytes;
};

inline constexpr std::array<PixelTypeTraits, 10> PixelTypes{ {
  { PixelType::UInt8, "uint8", "MET_UCHAR", 1 },
  { PixelType::Int8, "int8", "MET_CHAR", 1 },
  { PixelType::UInt16, "uint16", "MET_USHORT", 2 },
  { PixelType::Int16, "int16", "MET_SHORT", 2 },
  { PixelType::UInt32, "uint32", "MET_UINT", 4 },
  { PixelType::Int32, "int32", "MET_INT", 4 },
  { PixelType::UInt64, "uint64", "MET_ULONG_LONG", 8 },
  { PixelType::Int64, "int64", "MET_LONG_LONG", 8 },
  { PixelType::Float32, "float32", "MET_FLOAT", 4 },
  { PixelType::Float64, "float64", "MET_DOUBLE", 8 },
} };

inline const PixelTypeTraits &
GetTraits(PixelType type)
{
  return PixelTypes[static_cast<size_t>(type)];
}

inline std::optional<PixelType>
PixelTypeFromName(std::string_view name)
{
  for (const PixelTypeTraits & traits : PixelTypes)
  {
    if (traits.name == name)
    {
      return traits.type;
    }
  }
  return std::nullopt;
}

/** Calls function(T{}) with a value of the C++ type. */
template <typename TFunction>
auto
DispatchPixelType(PixelType type, TFunction && function)
{
  switch (type)
  {
    case PixelType::UInt8:
      return function(std::uint8_t{});
    case PixelType::Int8:
      return function(std::int8_t{});
    case PixelType::UInt16:
      return function(std::uint16_t{});
    case PixelType::Int16:
      return function(std::int16_t{});
    case PixelType::UInt32:
      return function(std::uint32_t{});
    case PixelType::Int32:
      return function(std::int32_t{});
    case PixelType::UInt64:
      return function(std::uint64_t{});
    case PixelType::Int64:
      return function(std::int64_t{});
    case PixelType::Float32:
      return function(float{});
    case PixelType::Float64:
      return function(double{});
  }
  Fail(ExitStatus::Failure, "pixel type ", static_cast<int>(type), " is not one of the types read");
}

} // end namespace medialvoxel

#endif
