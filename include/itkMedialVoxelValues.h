// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelValues_h
#define itkMedialVoxelValues_h

#include "itkMedialVoxelRows.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace itk
{

/** Types of the values of voxels.
 * \ingroup MedialVoxel */
enum class MedialVoxelValueType : std::uint8_t
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

/** \brief The type that values of a C++ type have.
 * \ingroup MedialVoxel
 */
template <typename TValue>
constexpr MedialVoxelValueType
MedialVoxelGetValueType()
{
  constexpr std::size_t bytes = sizeof(TValue);
  static_assert(std::is_arithmetic<TValue>::value && bytes <= 8, "Values are numbers of at most 64 bits.");
  if constexpr (std::is_floating_point<TValue>::value)
  {
    return bytes == 4 ? MedialVoxelValueType::Float32 : MedialVoxelValueType::Float64;
  }
  else
  {
    constexpr int width = bytes == 1 ? 0 : (bytes == 2 ? 1 : (bytes == 4 ? 2 : 3));
    return static_cast<MedialVoxelValueType>(2 * width + (std::is_signed<TValue>::value ? 1 : 0));
  }
}

/** \brief Call \a function(T{}) with a value of the C++ type.
 * \ingroup MedialVoxel
 */
template <typename TFunction>
auto
MedialVoxelWithValueType(const MedialVoxelValueType type, TFunction && function)
{
  switch (type)
  {
    case MedialVoxelValueType::UInt8:
      return function(std::uint8_t{});
    case MedialVoxelValueType::Int8:
      return function(std::int8_t{});
    case MedialVoxelValueType::UInt16:
      return function(std::uint16_t{});
    case MedialVoxelValueType::Int16:
      return function(std::int16_t{});
    case MedialVoxelValueType::UInt32:
      return function(std::uint32_t{});
    case MedialVoxelValueType::Int32:
      return function(std::int32_t{});
    case MedialVoxelValueType::UInt64:
      return function(std::uint64_t{});
    case MedialVoxelValueType::Int64:
      return function(std::int64_t{});
    case MedialVoxelValueType::Float32:
      return function(float{});
    default:
      return function(double{});
  }
}

/** \struct MedialVoxelValueView
 * \brief Values of a box where they lie in memory.
 * \ingroup MedialVoxel
 */
struct MedialVoxelValueView
{
  const void *       values{ nullptr }; ///< the first one; values of a row follow each other
  MedialVoxelStrides strides{};         ///< in values, from row to row and slice to slice
  bool               areEqual{ false }; ///< all of them, as nothing is stored for the box
};

} // end namespace itk

#endif
