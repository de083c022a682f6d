// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelOpenVoxels_h
#define itkMedialVoxelOpenVoxels_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelOpenVoxels
 * \brief The object voxels of a tile that have no value yet; each gets the first one that it is given.
 *
 * Painted from the largest to the smallest, balls give each voxel the value of the largest one that covers it. Bricks
 * of voxels without open ones are passed by.
 * \ingroup MedialVoxel
 */
class MedialVoxelOpenVoxels
{
public:
  /** Voxels of a row from \a lower up to but without \a upper; none when that is not above. */
  struct RowRange
  {
    std::int64_t lower;
    std::int64_t upper;
  };

  /** Opens all object voxels of \a box.
   * \param object  bits of the box
   * \param values  of the voxels of the box, x fastest: 0 in background; must stay as long as voxels are open */
  void
  Open(const MedialVoxelBox & box, const MedialVoxelBits & object, std::vector<float> & values);

  /** Whether all voxels have their values. */
  bool
  IsDone() const;

  /** Gives a value to the open voxels of a part of a row. */
  void
  CloseRange(const std::int64_t y, const std::int64_t z, const RowRange & range, const float value)
  {
    const std::int64_t first = (range.lower - m_Box.lower[0]) / MedialVoxelBits::BitsPerWord;
    const std::int64_t last = (range.upper - 1 - m_Box.lower[0]) / MedialVoxelBits::BitsPerWord;
    for (std::int64_t word = first; word <= last; ++word)
    {
      this->CloseInWord(y, z, word, range, value);
    }
  }

  /** Gives a value to the open voxels of a ball.
   * \param ball     box that holds it, around its center
   * \param getRange  getRange(y, z) returns its RowRange in a row of that box; ranges shrink with the distance of the
   * row from the center */
  template <typename TGetRange>
  void
  CloseBall(const MedialVoxelBox & ball, const float value, TGetRange && getRange)
  {
    const MedialVoxelBox part = ball.Intersection(m_Box);
    if (part.IsEmpty())
    {
      return;
    }
    const std::int64_t   y = (ball.lower[1] + ball.upper[1] - 1) / 2;
    const std::int64_t   z = (ball.lower[2] + ball.upper[2] - 1) / 2;
    const MedialVoxelBox bricks = this->GetBricks(part);
    MedialVoxelIndex     brick;
    for (brick[2] = bricks.lower[2]; brick[2] < bricks.upper[2]; ++brick[2])
    {
      for (brick[1] = bricks.lower[1]; brick[1] < bricks.upper[1]; ++brick[1])
      {
        for (brick[0] = bricks.lower[0]; brick[0] < bricks.upper[0]; ++brick[0])
        {
          const OpenLines & open = m_OpenLines[this->GetPlaceOfBrick(brick)];
          if (open.rows != 0 && this->MayHoldOpen(part, brick, open, y, z, getRange))
          {
            this->CloseInBrick(brick, part, value, getRange);
          }
        }
      }
    }
  }

  /** Gives a value to all voxels that are still open. */
  void
  CloseRest(float value);

private:
  /** Rows of a brick along y and z; along x it is a word. Its rows have a bit each in a word. */
  static constexpr std::int64_t BrickSize = 8;

  /** Rows and columns along x of a brick that may have open voxels: a bit each, y fastest. */
  struct OpenLines
  {
    std::uint64_t rows{ 0 };    ///< exactly these
    std::uint64_t columns{ 0 }; ///< all that have any
  };

  /** Whether the nearest row to the center of a ball that may be open is covered where a column may be. */
  template <typename TGetRange>
  bool
  MayHoldOpen(const MedialVoxelBox &   part,
              const MedialVoxelIndex & brick,
              const OpenLines &        open,
              const std::int64_t       centerY,
              const std::int64_t       centerZ,
              TGetRange &&             getRange) const
  {
    const MedialVoxelIndex first = this->GetFirstVoxel(brick);
    std::uint64_t          rowsOfSlice = open.rows | open.rows >> 32;
    rowsOfSlice |= rowsOfSlice >> 16;
    rowsOfSlice = (rowsOfSlice | rowsOfSlice >> 8) & 0xff;
    const std::int64_t y =
      std::clamp(centerY, first[1] + MedialVoxelLowestBit(rowsOfSlice), first[1] + MedialVoxelHighestBit(rowsOfSlice));
    const std::int64_t z = std::clamp(centerZ,
                                      first[2] + MedialVoxelLowestBit(open.rows) / BrickSize,
                                      first[2] + MedialVoxelHighestBit(open.rows) / BrickSize);
    if (y < part.lower[1] || y >= part.upper[1] || z < part.lower[2] || z >= part.upper[2])
    {
      return false;
    }
    const RowRange range = getRange(y, z);
    return (open.columns & MedialVoxelBits::RangeMask(0, range.lower - first[0], range.upper - first[0])) != 0;
  }

  template <typename TGetRange>
  void
  CloseInBrick(const MedialVoxelIndex & brick, const MedialVoxelBox & part, const float value, TGetRange && getRange)
  {
    const MedialVoxelIndex first = this->GetFirstVoxel(brick);
    OpenLines &            open = m_OpenLines[this->GetPlaceOfBrick(brick)];
    std::uint64_t          rows =
      open.rows &
      GetRows(part.lower[1] - first[1], part.upper[1] - first[1], part.lower[2] - first[2], part.upper[2] - first[2]);
    bool hasClosed = false;
    for (; rows != 0; rows &= rows - 1)
    {
      const int          row = MedialVoxelLowestBit(rows);
      const std::int64_t y = first[1] + row % BrickSize;
      const std::int64_t z = first[2] + row / BrickSize;
      hasClosed |= this->CloseInWord(y, z, brick[0], getRange(y, z), value);
    }
    if (hasClosed)
    {
      this->FindColumns(brick, open);
    }
  }

  /** Bits of the rows of a brick in a range of y and z, which may be beyond the brick. */
  static std::uint64_t
  GetRows(std::int64_t lowerY, std::int64_t upperY, std::int64_t lowerZ, std::int64_t upperZ)
  {
    constexpr std::uint64_t everyZ = 0x0101010101010101u;
    const std::uint64_t     rowsOfSlice = MedialVoxelBits::RangeMask(0, lowerY, std::min(upperY, BrickSize));
    return (rowsOfSlice * everyZ) & MedialVoxelBits::RangeMask(0, BrickSize * lowerZ, BrickSize * upperZ);
  }

  /** Returns whether any voxel was open. */
  bool
  CloseInWord(const std::int64_t y,
              const std::int64_t z,
              const std::int64_t word,
              const RowRange &   range,
              const float        value)
  {
    std::uint64_t &     open = m_Open[this->GetPlaceOfRow(y, z) + static_cast<std::size_t>(word)];
    const std::int64_t  first = m_Box.lower[0] + word * MedialVoxelBits::BitsPerWord;
    const std::uint64_t wanted = open & MedialVoxelBits::RangeMask(0, range.lower - first, range.upper - first);
    if (wanted != 0)
    {
      open &= ~wanted;
      this->SetValues(y, z, word, wanted, value);
      if (open == 0)
      {
        this->CloseRow(y, z, word);
      }
    }
    return wanted != 0;
  }

  void
  FindColumns(const MedialVoxelIndex & brick, OpenLines & open) const;

  void
  CloseRow(std::int64_t y, std::int64_t z, std::int64_t word);

  void
  SetValues(std::int64_t y, std::int64_t z, std::int64_t word, std::uint64_t bits, float value);

  std::size_t
  GetPlaceOfRow(const std::int64_t y, const std::int64_t z) const
  {
    return static_cast<std::size_t>(((z - m_Box.lower[2]) * m_Box.Extent(1) + (y - m_Box.lower[1])) * m_Words);
  }

  std::size_t
  GetPlaceOfBrick(const MedialVoxelIndex & brick) const
  {
    return static_cast<std::size_t>((brick[2] * m_Bricks + brick[1]) * m_Words + brick[0]);
  }

  /** The brick of a voxel. */
  MedialVoxelIndex
  GetBrickOf(const MedialVoxelIndex & voxel) const
  {
    return { { (voxel[0] - m_Box.lower[0]) / MedialVoxelBits::BitsPerWord,
               (voxel[1] - m_Box.lower[1]) / BrickSize,
               (voxel[2] - m_Box.lower[2]) / BrickSize } };
  }

  /** In the voxels of its brick. */
  std::uint64_t
  GetBitOfRow(const std::int64_t y, const std::int64_t z) const
  {
    return std::uint64_t{ 1 } << ((z - m_Box.lower[2]) % BrickSize * BrickSize + (y - m_Box.lower[1]) % BrickSize);
  }

  /** The bricks that a part of the box meets. */
  MedialVoxelBox
  GetBricks(const MedialVoxelBox & part) const
  {
    const MedialVoxelIndex last = this->GetBrickOf({ { part.upper[0] - 1, part.upper[1] - 1, part.upper[2] - 1 } });
    return { this->GetBrickOf(part.lower), { { last[0] + 1, last[1] + 1, last[2] + 1 } } };
  }

  MedialVoxelIndex
  GetFirstVoxel(const MedialVoxelIndex & brick) const
  {
    return { { m_Box.lower[0] + brick[0] * MedialVoxelBits::BitsPerWord,
               m_Box.lower[1] + brick[1] * BrickSize,
               m_Box.lower[2] + brick[2] * BrickSize } };
  }

  MedialVoxelBox             m_Box;
  std::int64_t               m_Words{ 0 };  // of a row
  std::int64_t               m_Bricks{ 0 }; // along y
  std::vector<std::uint64_t> m_Open;
  std::vector<OpenLines>     m_OpenLines; // of each brick
  float *                    m_Values{ nullptr };
};

} // end namespace itk

#endif
