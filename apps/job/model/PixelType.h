// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPixelType_h
#define medialvoxelPixelType_h

#include "Errors.h"

#include "itkMedialVoxelValues.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace medialvoxel
{

/** Types of voxel values that are read. */
using PixelType = itk::MedialVoxelValueType;

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
  return itk::MedialVoxelWithValueType(type, function);
}

} // end namespace medialvoxel

#endif
