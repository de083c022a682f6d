// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelDilation.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Word = MedialVoxelBits::WordType;

/** Calls function(y, z) for the rows of a box. */
template <typename TFunction>
void
ForEachRow(const MedialVoxelBox & box, TFunction && function)
{
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      function(y, z);
    }
  }
}

MedialVoxelBits
DilateRows(const MedialVoxelBits & bits, const std::int64_t reach)
{
  MedialVoxelBits result(bits.GetBox());
  ForEachRow(bits.GetBox(), [&](const std::int64_t y, const std::int64_t z) {
    const Word * const from = bits.GetRow(y, z);
    Word * const       to = result.GetRow(y, z);
    for (std::int64_t i = 0; i < bits.GetWordsPerRow(); ++i)
    {
      to[i] = from[i];
      for (std::int64_t k = 1; k <= reach; ++k)
      {
        to[i] |= (from[i] << k | from[i - 1] >> (MedialVoxelBits::BitsPerWord - k)) |
                 (from[i] >> k | from[i + 1] << (MedialVoxelBits::BitsPerWord - k));
      }
    }
  });
  return result;
}

/** Along y or z, from the rows around each row. */
MedialVoxelBits
DilateAcross(const MedialVoxelBits & bits, const std::int64_t reach, const unsigned int axis)
{
  const MedialVoxelBox & box = bits.GetBox();
  MedialVoxelBits        result(box);
  ForEachRow(box, [&](const std::int64_t y, const std::int64_t z) {
    Word * const       to = result.GetRow(y, z);
    const std::int64_t own = axis == 1 ? y : z;
    const std::int64_t end = std::min(own + reach + 1, box.upper[axis]);
    for (std::int64_t i = std::max(own - reach, box.lower[axis]); i < end; ++i)
    {
      const Word * const from = axis == 1 ? bits.GetRow(i, z) : bits.GetRow(y, i);
      for (std::int64_t word = 0; word < bits.GetWordsPerRow(); ++word)
      {
        to[word] |= from[word];
      }
    }
  });
  return result;
}

} // namespace

MedialVoxelBits
MedialVoxelDilate(const MedialVoxelBits & bits, const std::int64_t reach)
{
  assert(reach >= 1 && reach < MedialVoxelBits::BitsPerWord);
  return DilateAcross(DilateAcross(DilateRows(bits, reach), reach, 1), reach, 2);
}

} // end namespace itk
