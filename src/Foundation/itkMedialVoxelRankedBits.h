// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRankedBits_h
#define itkMedialVoxelRankedBits_h

#include "itkMedialVoxelBits.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelRankedBits
 * \brief Bits that are numbered in the order x, y, z, so that an array holds something for each of them.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelRankedBits
{
public:
  using WordType = MedialVoxelBits::WordType;

  /** Set the box and clear all bits; then set bits, then call Rank(). */
  void
  Reshape(const MedialVoxelBox & box);

  void
  Set(const MedialVoxelIndex & index)
  {
    m_Bits.Set(index);
  }

  /** Number the bits. */
  void
  Rank();

  const MedialVoxelBits &
  GetBits() const
  {
    return m_Bits;
  }

  std::size_t
  GetNumberOfBits() const
  {
    return m_NumberOfBits;
  }

  /** Bits that are set before \a bit, which has one bit set, of the word \a i of the row at (y, z). */
  std::size_t
  RankOf(const std::int64_t i, const std::int64_t y, const std::int64_t z, const WordType bit) const
  {
    const MedialVoxelBox & box = m_Bits.GetBox();
    const std::int64_t     row = (z - box.lower[2]) * box.Extent(1) + (y - box.lower[1]);
    const auto             word = static_cast<std::size_t>(row * m_Bits.GetWordsPerRow() + i);
    return m_Before[word] + static_cast<std::size_t>(MedialVoxelPopulationCount(m_Bits.GetRow(y, z)[i] & (bit - 1)));
  }

  /** Bits that are set before that of \a index, which is set. */
  std::size_t
  RankOf(const MedialVoxelIndex & index) const
  {
    return this->RankOf((index[0] >> 6) - m_Bits.GetFirstWord(), index[1], index[2], WordType{ 1 } << (index[0] & 63));
  }

private:
  MedialVoxelBits            m_Bits;
  std::vector<std::uint32_t> m_Before;
  std::size_t                m_NumberOfBits{ 0 };
};

} // end namespace itk

#endif
