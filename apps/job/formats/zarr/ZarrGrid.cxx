// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrGrid.h"

#include <algorithm>
#include <vector>

namespace medialvoxel
{
namespace
{

constexpr ZarrIndex LargestChunk{ { 256, 256, 32 } };
constexpr ZarrIndex LargestFlatChunk{ { 1024, 1, 1024 } };

/** The least length with which as many chunks reach the end. */
std::uint64_t
BalanceChunk(std::uint64_t size, std::uint64_t largest)
{
  const std::uint64_t chunks = (size + largest - 1) / largest;
  return (size + chunks - 1) / chunks;
}

/** Copies every \a fromStep-th value to every \a toStep-th place. */
template <typename TValue>
void
CopyRow(const TValue * from, std::uint64_t fromStep, TValue * to, std::uint64_t toStep, std::uint64_t count)
{
  if (fromStep == 1 && toStep == 1)
  {
    std::copy_n(from, count, to);
    return;
  }
  for (std::uint64_t i = 0; i < count; ++i)
  {
    to[i * toStep] = from[i * fromStep];
  }
}

} // namespace

ZarrGrid
ZarrGrid::ForVolume(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  ZarrGrid grid;
  grid.dimension = geometry.GetDimension();
  const bool isFlat = grid.dimension == 2;
  grid.size = { geometry.size[0], isFlat ? 1 : geometry.size[1], geometry.size.back() };
  const ZarrIndex & largest = isFlat ? LargestFlatChunk : LargestChunk;
  std::transform(grid.size.begin(), grid.size.end(), largest.begin(), grid.chunk.begin(), BalanceChunk);
  grid.layout = layout;
  grid.leadingAxes = layout.components > 1 ? 1 : 0;
  return grid;
}

std::string
ZarrGrid::GetChunkName(std::uint64_t component, const ZarrIndex & index) const
{
  std::vector<std::uint64_t> places(leadingAxes, 0);
  if (leadingAxes > 0)
  {
    places.back() = component;
  }
  places.push_back(index[2]);
  if (dimension == 3)
  {
    places.push_back(index[1]);
  }
  places.push_back(index[0]);
  std::string name = prefix;
  for (const std::uint64_t place : places)
  {
    name += (name.empty() ? "" : std::string(1, separator)) + std::to_string(place);
  }
  return name;
}

ZarrBox
ZarrGrid::GetBox(const ZarrIndex & index) const
{
  ZarrBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.begin[axis] = index[axis] * chunk[axis];
    box.size[axis] = std::min(chunk[axis], size[axis] - box.begin[axis]);
  }
  return box;
}

ZarrBox
Intersect(const ZarrBox & a, const ZarrBox & b)
{
  ZarrBox shared;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::uint64_t end = std::min(a.begin[axis] + a.size[axis], b.begin[axis] + b.size[axis]);
    shared.begin[axis] = std::max(a.begin[axis], b.begin[axis]);
    if (end <= shared.begin[axis])
    {
      return {};
    }
    shared.size[axis] = end - shared.begin[axis];
  }
  return shared;
}

void
GatherSlices(const ZarrGrid & grid,
             std::uint64_t    component,
             std::uint64_t    chunkX,
             std::uint64_t    chunkY,
             std::uint64_t    numberOfSlices,
             const RowRange & rows,
             const void *     voxels,
             void *           planes)
{
  const ZarrBox       box = grid.GetBox({ chunkX, chunkY, 0 });
  const std::uint64_t components = grid.layout.components;
  DispatchPixelType(grid.layout.pixelType, [&](auto zero) {
    using ValueType = decltype(zero);
    auto * to = static_cast<ValueType *>(planes);
    for (std::uint64_t z = 0; z < numberOfSlices; ++z)
    {
      for (std::uint64_t y = 0; y < box.size[1]; ++y, to += grid.chunk[0])
      {
        const std::uint64_t row = z * (rows.end - rows.begin) + box.begin[1] - rows.begin + y;
        const std::uint64_t first = row * grid.size[0] + box.begin[0];
        const auto * const  from = static_cast<const ValueType *>(voxels) + first * components + component;
        CopyRow(from, components, to, 1, box.size[0]);
        std::fill(to + box.size[0], to + grid.chunk[0], zero);
      }
      to = std::fill_n(to, (grid.chunk[1] - box.size[1]) * grid.chunk[0], zero);
    }
  });
}

void
ScatterSlices(const ZarrGrid &  grid,
              std::uint64_t     component,
              const ZarrIndex & index,
              const ZarrBox &   part,
              const void *      planes,
              const ZarrBox &   box,
              void *            voxels)
{
  const ZarrIndex     chunkBegin = grid.GetBox(index).begin;
  const std::uint64_t components = grid.layout.components;
  DispatchPixelType(grid.layout.pixelType, [&](auto zero) {
    using ValueType = decltype(zero);
    for (std::uint64_t z = 0; z < part.size[2]; ++z)
    {
      for (std::uint64_t row = 0; row < part.size[1]; ++row)
      {
        const std::uint64_t y = part.begin[1] + row;
        const std::uint64_t inChunk =
          (z * grid.chunk[1] + y - chunkBegin[1]) * grid.chunk[0] + part.begin[0] - chunkBegin[0];
        const std::uint64_t inBox =
          ((part.begin[2] + z - box.begin[2]) * box.size[1] + y - box.begin[1]) * box.size[0] + part.begin[0] -
          box.begin[0];
        CopyRow(static_cast<const ValueType *>(planes) + inChunk,
                1,
                static_cast<ValueType *>(voxels) + inBox * components + component,
                components,
                part.size[0]);
      }
    }
  });
}

} // end namespace medialvoxel
