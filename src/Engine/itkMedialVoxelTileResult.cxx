// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileResult.h"

#include "itkMedialVoxelLengthRow.h"
#include "itkMedialVoxelTileWalls.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

double
DistanceAt(const MedialVoxelFeatures & displacements, const std::size_t offset, const MedialVoxelDistanceScale & scale)
{
  const double x = displacements.dx[offset] * scale.spacing[0];
  const double y = displacements.dy[offset] * scale.spacing[1];
  const double z = displacements.dz[offset] * scale.spacing[2];
  const double squared = (x * x + y * y) + z * z;
  return scale.squared ? squared : std::sqrt(squared);
}

} // namespace

/** The value of each measured wall, and 0 elsewhere. */
template <typename TGetValue>
void
MedialVoxelTileResult::WriteWalls(const TGetValue &          getValue,
                                  float * const              first,
                                  const MedialVoxelStrides & strides) const
{
  MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    std::fill_n(first + offset, row.Extent(0), 0.0f);
  });
  if (isEmpty)
  {
    return;
  }
  MedialVoxelForEachWall(*rows, *walls, [&](const MedialVoxelIndex & cell, const MedialVoxelWall & wall) {
    std::int64_t offset = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      offset += (cell[axis] - box.lower[axis]) * strides[axis];
    }
    first[offset] = getValue(wall);
  });
}

void
MedialVoxelTileResult::WriteThickness(float * const first, const MedialVoxelStrides & strides) const
{
  this->WriteWalls([](const MedialVoxelWall & wall) { return wall.GetMarkedThickness(); }, first, strides);
}

void
MedialVoxelTileResult::WriteUncertainty(float * const first, const MedialVoxelStrides & strides) const
{
  this->WriteWalls([](const MedialVoxelWall & wall) { return wall.uncertainty; }, first, strides);
}

void
MedialVoxelTileResult::WriteLocalThickness(float * const first, const MedialVoxelStrides & strides) const
{
  this->WriteValues(localThickness, first, strides);
}

void
MedialVoxelTileResult::WriteImportance(float * const first, const MedialVoxelStrides & strides) const
{
  this->WriteValues(importance, first, strides);
}

void
MedialVoxelTileResult::WriteImportanceThreshold(float * const first, const MedialVoxelStrides & strides) const
{
  this->WriteValues(importanceThresholds, first, strides);
}

void
MedialVoxelTileResult::WriteTopologyCells(std::uint16_t * const first, const MedialVoxelStrides & strides) const
{
  std::size_t source = 0;
  MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    std::uint16_t * const target = first + offset;
    if (isEmpty)
    {
      std::fill_n(target, row.Extent(0), std::uint16_t{ 0 });
      return;
    }
    // Compilers vectorize a loop without bits.
    std::transform(
      labels + source, labels + source + row.Extent(0), levels->data() + source, target, [](auto label, auto level) {
        return MedialVoxelTopologyCell{ label, false, level }.Pack();
      });
    source += static_cast<std::size_t>(row.Extent(0));
    const auto * const words = object->GetRow(row.lower[1], row.lower[2]) - object->GetFirstWord();
    constexpr auto     bitsPerWord = MedialVoxelBits::BitsPerWord;
    for (std::int64_t word = row.lower[0] / bitsPerWord; word * bitsPerWord < row.upper[0]; ++word)
    {
      for (auto bits = words[word] & MedialVoxelBits::RangeMask(word, row.lower[0], row.upper[0]); bits != 0;
           bits &= bits - 1)
      {
        target[word * bitsPerWord + MedialVoxelLowestBit(bits) - row.lower[0]] |= MedialVoxelTopologyCell::OfObject;
      }
    }
  });
}

/** The values of all voxels of the tile, 0 in an empty one. */
void
MedialVoxelTileResult::WriteValues(const std::vector<float> * const values,
                                   float * const                    first,
                                   const MedialVoxelStrides &       strides) const
{
  const float * source = values == nullptr ? nullptr : values->data();
  MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    float * const target = first + offset;
    if (isEmpty)
    {
      std::fill_n(target, row.Extent(0), 0.0f);
      return;
    }
    std::copy_n(source, row.Extent(0), target);
    source += row.Extent(0);
  });
}

void
MedialVoxelTileResult::WriteDistances(const MedialVoxelDistanceScale & scale,
                                      float * const                    first,
                                      const MedialVoxelStrides &       strides) const
{
  assert(!isEmpty && object != nullptr);
  if (squaredLengths != nullptr)
  {
    this->WriteLengths(scale, first, strides);
    return;
  }
  assert(displacements != nullptr);
  MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    const std::size_t from = displacements->OffsetOf(row.lower[0], row.lower[1], row.lower[2]);
    const auto *      words = object->GetRow(row.lower[1], row.lower[2]) - object->GetFirstWord();
    float * const     target = first + offset;
    for (std::int64_t i = 0; i < row.Extent(0); ++i)
    {
      const std::size_t at = from + static_cast<std::size_t>(i);
      if (!displacements->HasSite(at))
      {
        target[i] = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      const double       distance = DistanceAt(*displacements, at, scale);
      const std::int64_t x = row.lower[0] + i;
      const bool isInside = ((words[x / MedialVoxelBits::BitsPerWord] >> (x % MedialVoxelBits::BitsPerWord)) & 1u) != 0;
      target[i] = static_cast<float>(isInside == scale.insideIsPositive ? distance : 0.0 - distance);
    }
  });
}

void
MedialVoxelTileResult::WriteLengths(const MedialVoxelDistanceScale & scale,
                                    float * const                    first,
                                    const MedialVoxelStrides &       strides) const
{
  constexpr std::int64_t     most = MedialVoxelLengthRow::MostVoxels;
  const MedialVoxelLengthRow writer(squaredLengths->spacing, scale.squared);
  const std::uint64_t        flip = scale.insideIsPositive ? ~std::uint64_t{ 0 } : 0;
  MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    const std::int64_t   y = row.lower[1];
    const std::int64_t   z = row.lower[2];
    const std::int32_t * squares = squaredLengths->values.data() + squaredLengths->box.OffsetOf(row.lower);
    for (std::int64_t i = 0; i < row.Extent(0); i += most)
    {
      writer.Write(squares + i,
                   std::min(most, row.Extent(0) - i),
                   object->Extract(row.lower[0] + i, y, z) ^ flip,
                   first + offset + i);
    }
  });
}

} // end namespace itk
