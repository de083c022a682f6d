// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectPass.h"

#include <algorithm>

namespace itk
{
namespace
{

/** Slices that are in memory: few, but enough for all threads. */
constexpr std::int64_t LeastSlices = 16;

/** Rows that one thread reads, when it reads strips of them. */
constexpr std::int64_t LeastRows = 32;

MedialVoxelBox
WithSlices(MedialVoxelBox box, const std::int64_t begin, const std::int64_t end)
{
  box.lower[2] = begin;
  box.upper[2] = end;
  return box;
}

} // namespace

void
MedialVoxelObjectPass::Run(const MedialVoxelBox & image, const std::int64_t layer, const Look & look) const
{
  const std::int64_t end = image.upper[2];
  const std::int64_t step = std::max(LeastSlices, slices);
  MedialVoxelBits    object;
  std::int64_t       done = 0;
  for (std::int64_t z = 0; z < end; z += step)
  {
    observe(static_cast<double>(z) / static_cast<double>(end));
    const MedialVoxelBox read = WithSlices(image, z, std::min(z + step, end));
    const MedialVoxelBox window = WithSlices(image, std::max<std::int64_t>(done - 1, 0), read.upper[2]);
    object.Reframe(window, window);
    forEach(Cut(read, rows), [&](const MedialVoxelBox & part) { fill(part, object); });
    // The last slice that was read waits for the one after it.
    const std::int64_t ready = read.upper[2] == end ? end : (read.upper[2] - 1) / layer * layer;
    if (ready > done)
    {
      look(object, WithSlices(image, done, ready));
      done = ready;
    }
  }
}

auto
MedialVoxelObjectPass::Cut(const MedialVoxelBox & box, const std::int64_t rows) -> Boxes
{
  const bool         isSlices = rows == 1 && box.Extent(2) > 1;
  const unsigned int axis = isSlices ? 2 : 1;
  const std::int64_t unit = isSlices ? 1 : std::max(rows, LeastRows);
  Boxes              parts;
  for (MedialVoxelBox part = box; part.lower[axis] < box.upper[axis]; part.lower[axis] = part.upper[axis])
  {
    part.upper[axis] = std::min((part.lower[axis] / unit + 1) * unit, box.upper[axis]);
    parts.push_back(part);
  }
  return parts;
}

} // end namespace itk
