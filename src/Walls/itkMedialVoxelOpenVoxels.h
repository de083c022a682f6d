// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelOpenVoxels_h
#define itkMedialVoxelOpenVoxels_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"

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
  struct Span
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
  CloseSpan(const std::int64_t y, const std::int64_t z, const Span & span, const float value)
  {
    const std::int64_t first = (span.lower - m_Box.lower[0]) / MedialVoxelBits::BitsPerWord;
    const std::int64_t last = (span.upper - 1 - m_Box.lower[0]) / MedialVoxelBits::BitsPerWord;
    for (std::int64_t word = first; word <= last; ++word)
    {
      this->CloseInWord(y, z, word, span, value);
    }
  }

  /** Gives a value to the open voxels of a ball.
   * \param ball     box that holds it
   * \param getSpan  getSpan(y, z) returns its Span in a row of that box */
  template <typename TGetSpan>
  void
  CloseBall(const MedialVoxelBox & ball, const float value, TGetSpan && getSpan)
  {
    const MedialVoxelBox part = ball.Intersection(m_Box);
    if (part.IsEmpty())
    {
      return;
    }
    const MedialVoxelBox bricks = this->GetBricks(part);
    MedialVoxelIndex     brick;
    for (brick[2] = bricks.lower[2]; brick[2] < bricks.upper[2]; ++brick[2])
    {
      for (brick[1] = bricks.lower[1]; brick[1] < bricks.upper[1]; ++brick[1])
      {
        for (brick[0] = bricks.lower[0]; brick[0] < bricks.upper[0]; ++brick[0])
        {
          if (m_OpenOfBricks[this->GetPlaceOfBrick(brick)] != 0)
          {
            this->CloseInBrick(this->GetBrick(brick).Intersection(part), brick[0], value, getSpan);
          }
        }
      }
    }
  }

  /** Gives a value to all voxels that are still open. */
  void
  CloseRest(float value);

private:
  /** Rows of a brick along y and z; along x it is a word. */
  static constexpr std::int64_t BrickSize = 8;

  template <typename TGetSpan>
  void
  CloseInBrick(const MedialVoxelBox & part, const std::int64_t word, const float value, TGetSpan && getSpan)
  {
    for (std::int64_t z = part.lower[2]; z < part.upper[2]; ++z)
    {
      for (std::int64_t y = part.lower[1]; y < part.upper[1]; ++y)
      {
        this->CloseInWord(y, z, word, getSpan(y, z), value);
      }
    }
  }

  void
  CloseInWord(const std::int64_t y, const std::int64_t z, const std::int64_t word, const Span & span, const float value)
  {
    std::uint64_t &     open = m_Open[this->GetPlaceOfRow(y, z) + static_cast<std::size_t>(word)];
    const std::int64_t  first = m_Box.lower[0] + word * MedialVoxelBits::BitsPerWord;
    const std::uint64_t wanted = open & MedialVoxelBits::RangeMask(0, span.lower - first, span.upper - first);
    if (wanted != 0)
    {
      open &= ~wanted;
      this->SetValues(y, z, word, wanted, value);
    }
  }

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

  /** The bricks that a part of the box meets. */
  MedialVoxelBox
  GetBricks(const MedialVoxelBox & part) const
  {
    const MedialVoxelIndex last = this->GetBrickOf({ { part.upper[0] - 1, part.upper[1] - 1, part.upper[2] - 1 } });
    return { this->GetBrickOf(part.lower), { { last[0] + 1, last[1] + 1, last[2] + 1 } } };
  }

  /** The voxels of a brick. */
  MedialVoxelBox
  GetBrick(const MedialVoxelIndex & brick) const
  {
    const MedialVoxelIndex lower{ { m_Box.lower[0] + brick[0] * MedialVoxelBits::BitsPerWord,
                                    m_Box.lower[1] + brick[1] * BrickSize,
                                    m_Box.lower[2] + brick[2] * BrickSize } };
    return { lower, { { lower[0] + MedialVoxelBits::BitsPerWord, lower[1] + BrickSize, lower[2] + BrickSize } } };
  }

  MedialVoxelBox             m_Box;
  std::int64_t               m_Words{ 0 };  // of a row
  std::int64_t               m_Bricks{ 0 }; // along y
  std::vector<std::uint64_t> m_Open;
  std::vector<std::uint32_t> m_OpenOfBricks; // numbers of open voxels
  float *                    m_Values{ nullptr };
};

} // end namespace itk

#endif
