// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoundary.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>
#include <vector>

namespace itk
{
namespace
{

using WordType = MedialVoxelBits::WordType;

/** OR of the rows around (y, z) that the image has, bits inverted by \a flip and limited to the image. */
void
AccumulateRows(const MedialVoxelBits & object,
               const MedialVoxelBox &  image,
               const WordType          flip,
               const std::int64_t      y,
               const std::int64_t      z,
               const std::int64_t      firstWord,
               std::vector<WordType> & sum)
{
  std::fill(sum.begin(), sum.end(), 0);
  for (std::int64_t nz = std::max(z - 1, image.lower[2]); nz < std::min(z + 2, image.upper[2]); ++nz)
  {
    for (std::int64_t ny = std::max(y - 1, image.lower[1]); ny < std::min(y + 2, image.upper[1]); ++ny)
    {
      // The words run from one before the box to one after it, as neighbors along x carry over.
      const WordType * const row = object.GetRow(ny, nz) - object.GetFirstWord();
      const std::int64_t     lowest = object.GetFirstWord() - 1;
      const std::int64_t     highest = object.GetFirstWord() + object.GetWordsPerRow();
      for (std::size_t i = 0; i < sum.size(); ++i)
      {
        const std::int64_t word = firstWord - 1 + static_cast<std::int64_t>(i);
        const WordType     bits = (word < lowest || word > highest) ? 0 : row[word];
        sum[i] |= bits ^ flip;
      }
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
  {
    sum[i] &= MedialVoxelBits::RangeMask(firstWord - 1 + static_cast<std::int64_t>(i), image.lower[0], image.upper[0]);
  }
}

/** Which rows around a slice have an object voxel. */
class RowsInUse
{
public:
  RowsInUse(const MedialVoxelBits & object, const MedialVoxelBox & box)
    : m_Object(object)
    , m_Box(box)
  {
    for (auto & slice : m_Slices)
    {
      slice.resize(static_cast<std::size_t>(box.Extent(1) + 2));
    }
    this->Fill(m_Slices[1], box.lower[2] - 1);
    this->Fill(m_Slices[2], box.lower[2]);
  }

  /** To the first slice of the box, then to the next one each time. */
  void
  MoveTo(const std::int64_t z)
  {
    m_Slices[0].swap(m_Slices[1]);
    m_Slices[1].swap(m_Slices[2]);
    this->Fill(m_Slices[2], z + 1);
  }

  bool
  AnyAround(const std::int64_t y) const
  {
    const auto first = static_cast<std::size_t>(y - m_Box.lower[1]);
    return std::any_of(m_Slices.begin(), m_Slices.end(), [first](const std::vector<unsigned char> & slice) {
      return (slice[first] | slice[first + 1] | slice[first + 2]) != 0;
    });
  }

private:
  void
  Fill(std::vector<unsigned char> & slice, const std::int64_t z) const
  {
    MedialVoxelBox row = m_Object.GetBox();
    row.lower[2] = z;
    row.upper[2] = z + 1;
    for (std::size_t i = 0; i < slice.size(); ++i)
    {
      row.lower[1] = m_Box.lower[1] - 1 + static_cast<std::int64_t>(i);
      row.upper[1] = row.lower[1] + 1;
      slice[i] = m_Object.Any(row) ? 1 : 0;
    }
  }

  const MedialVoxelBits &                   m_Object;
  MedialVoxelBox                            m_Box;
  std::array<std::vector<unsigned char>, 3> m_Slices;
};

} // namespace

void
MedialVoxelComputeBoundary(const MedialVoxelBits &   object,
                           const MedialVoxelBox &    image,
                           const MedialVoxelBoundary kind,
                           const MedialVoxelBox &    box,
                           MedialVoxelBits &         boundary)
{
  if (box.IsEmpty())
  {
    return;
  }
  // The background border neighbors object voxels, the object border neighbors background voxels.
  const bool         isObjectBorder = (kind == MedialVoxelBoundary::Object);
  const WordType     neighborFlip = isObjectBorder ? ~WordType{ 0 } : WordType{ 0 };
  const std::int64_t firstWord = box.lower[0] / MedialVoxelBits::BitsPerWord;
  const std::int64_t words = (box.upper[0] - 1) / MedialVoxelBits::BitsPerWord - firstWord + 1;

  // Most rows of most volumes have no object voxel around, and nothing to decide.
  RowsInUse             rows(object, box);
  std::vector<WordType> sum(static_cast<std::size_t>(words + 2));
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    MedialVoxelCheckAbort();
    rows.MoveTo(z);
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      if (!rows.AnyAround(y))
      {
        continue;
      }
      AccumulateRows(object, image, neighborFlip, y, z, firstWord, sum);
      const WordType * const own = object.GetRow(y, z) - object.GetFirstWord();
      WordType * const       target = boundary.GetRow(y, z) - boundary.GetFirstWord();
      for (std::int64_t word = 0; word < words; ++word)
      {
        const WordType left = sum[static_cast<std::size_t>(word)];
        const WordType center = sum[static_cast<std::size_t>(word + 1)];
        const WordType right = sum[static_cast<std::size_t>(word + 2)];
        const WordType reached = center | (center << 1) | (left >> 63) | (center >> 1) | (right << 63);
        const WordType side = isObjectBorder ? own[firstWord + word] : ~own[firstWord + word];
        target[firstWord + word] |=
          reached & side & MedialVoxelBits::RangeMask(firstWord + word, box.lower[0], box.upper[0]);
      }
    }
  }
}

} // end namespace itk
