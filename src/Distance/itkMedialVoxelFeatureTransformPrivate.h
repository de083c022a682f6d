// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFeatureTransformPrivate_h
#define itkMedialVoxelFeatureTransformPrivate_h

#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelReserve.h"

#include <algorithm>

namespace itk
{

/** Relative slack that keeps rounded lengths on the safe side. */
constexpr double RelativeSlack = 1e-9;

/** \struct MedialVoxelRemainingRow
 * \brief The bits of a row of voxels that remain, bit 0 the lowest one of its first word.
 * \ingroup MedialVoxel
 */
struct MedialVoxelRemainingRow
{
  MedialVoxelBits::WordType * first;
  std::int64_t                words;

  /** The next bit that is set, from \a bit on; the number of bits when none is. */
  std::int64_t
  Next(const std::int64_t bit) const
  {
    std::int64_t word = bit >> 6;
    if (word >= words)
    {
      return words * MedialVoxelBits::BitsPerWord;
    }
    MedialVoxelBits::WordType rest = first[word] & (~MedialVoxelBits::WordType{ 0 } << (bit & 63));
    while (rest == 0 && ++word < words)
    {
      rest = first[word];
    }
    return word * MedialVoxelBits::BitsPerWord + (rest == 0 ? 0 : MedialVoxelLowestBit(rest));
  }

  /** The 64 bits from \a bit on. */
  MedialVoxelBits::WordType
  Extract(const std::int64_t bit) const
  {
    const std::int64_t word = bit >> 6;
    const std::int64_t shift = bit & 63;
    const bool         isSplit = shift != 0 && word + 1 < words;
    return (first[word] >> shift) | (isSplit ? first[word + 1] << (MedialVoxelBits::BitsPerWord - shift) : 0);
  }

  /** Of the 64 bits from \a bit on, clear the ones set in \a bits. */
  void
  Clear(const std::int64_t bit, const MedialVoxelBits::WordType bits) const
  {
    const std::int64_t word = bit >> 6;
    const std::int64_t shift = bit & 63;
    first[word] &= ~(bits << shift);
    if (shift != 0 && word + 1 < words)
    {
      first[word + 1] &= ~(bits >> (MedialVoxelBits::BitsPerWord - shift));
    }
  }
};

/** Shared by the steps of the transform of one tile. */
struct MedialVoxelFeatureTransform::Tile
{
  const MedialVoxelWindow &                window;
  MedialVoxelFeatures &                    features;
  std::vector<MedialVoxelBits::WordType> & remaining;
  MedialVoxelBox                           known;
  const MedialVoxelProgress * const        progress;
  double                                   squaredDistanceToUnknown{ 0.0 };

  /** Words of a row that hold voxels of the tile. */
  std::int64_t firstWord{ 0 };
  std::int64_t words{ 0 };

  /** Voxels that the nearby search left, and the metric length within which their sites lie. */
  MedialVoxelBox remainingBox{};
  double         reach{ 0.0 };

  double         largestSquaredLength{ 0.0 };
  MedialVoxelBox missing{};

  bool
  IsAborted() const
  {
    return progress != nullptr && progress->IsAborted();
  }

  const MedialVoxelBox &
  Box() const
  {
    return features.box;
  }

  MedialVoxelBits::WordType &
  Remaining(const std::int64_t word, const std::int64_t y, const std::int64_t z) const
  {
    const MedialVoxelBox & box = features.box;
    const std::int64_t     row = (z - box.lower[2]) * box.Extent(1) + (y - box.lower[1]);
    return remaining[static_cast<std::size_t>(row * words + word - firstWord)];
  }

  bool
  IsRemaining(const std::int64_t x, const std::int64_t y, const std::int64_t z) const
  {
    return ((this->Remaining(x >> 6, y, z) >> (x & 63)) & 1u) != 0;
  }

  void
  FindRemainingBox()
  {
    remainingBox = {};
    for (std::int64_t z = Box().lower[2]; z < Box().upper[2]; ++z)
    {
      remainingBox = remainingBox.Union(this->RemainingBoxOf(z, Box()));
    }
  }

  /** Box of the remaining voxels in a slice of \a range. */
  MedialVoxelBox
  RemainingBoxOf(const std::int64_t z, const MedialVoxelBox & range) const
  {
    MedialVoxelBox result{ { { range.upper[0], range.upper[1], z } }, { { range.lower[0], range.lower[1], z + 1 } } };
    for (std::int64_t y = range.lower[1]; y < range.upper[1]; ++y)
    {
      for (std::int64_t word = range.lower[0] >> 6; word <= (range.upper[0] - 1) >> 6; ++word)
      {
        const MedialVoxelBits::WordType bits = this->Remaining(word, y, z);
        if (bits != 0)
        {
          const std::int64_t x = word * MedialVoxelBits::BitsPerWord;
          result.lower[0] = std::min(result.lower[0], x + MedialVoxelLowestBit(bits));
          result.upper[0] = std::max(result.upper[0], x + MedialVoxelHighestBit(bits) + 1);
          result.lower[1] = std::min(result.lower[1], y);
          result.upper[1] = y + 1;
        }
      }
    }
    return result.IsEmpty() ? MedialVoxelBox{} : result;
  }

  bool
  AnyRemaining(const MedialVoxelBox & block) const
  {
    for (std::int64_t z = block.lower[2]; z < block.upper[2]; ++z)
    {
      for (std::int64_t y = block.lower[1]; y < block.upper[1]; ++y)
      {
        for (std::int64_t word = block.lower[0] >> 6; word <= (block.upper[0] - 1) >> 6; ++word)
        {
          if (this->Remaining(word, y, z) & MedialVoxelBits::RangeMask(word, block.lower[0], block.upper[0]))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  void
  Store(const std::size_t offset, const std::int64_t dx, const std::int64_t dy, const std::int64_t dz) const
  {
    features.dx[offset] = static_cast<std::int32_t>(dx);
    features.dy[offset] = static_cast<std::int32_t>(dy);
    features.dz[offset] = static_cast<std::int32_t>(dz);
  }

  void
  StoreNone(const std::size_t offset) const
  {
    this->Store(offset, MedialVoxelNoDisplacement, MedialVoxelNoDisplacement, MedialVoxelNoDisplacement);
  }
};

} // end namespace itk

#endif
