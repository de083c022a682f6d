// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBoxComponents_h
#define itkMedialVoxelBoxComponents_h

#include "itkMedialVoxelBits.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace itk
{

/** \class MedialVoxelBoxComponents
 * \brief Connected components of the boundary points of a small box, by runs along x.
 *
 * Points that differ by at most 1 along each axis are connected. Two points in different components are not joined by
 * any path that stays inside the box.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBoxComponents
{
public:
  /** Rows of a box are not longer. */
  static constexpr std::int64_t LongestRow = MedialVoxelBits::BitsPerWord;

  /** Find the components of \a boundary in \a box, which the box of \a boundary holds. */
  void
  Label(const MedialVoxelBits & boundary, const MedialVoxelBox & box);

  /** True when a path inside the box joins two boundary points of it. \throw std::out_of_range for other points. */
  bool
  AreConnected(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const
  {
    return m_Runs[this->RunAt(a)].parent == m_Runs[this->RunAt(b)].parent;
  }

private:
  /** Points of a row, as bits from the beginning of the box on. */
  struct Run
  {
    std::uint64_t bits;
    std::uint32_t parent; // the first run of the component when all are labeled
  };

  std::size_t
  RowOf(const std::int64_t y, const std::int64_t z) const
  {
    return static_cast<std::size_t>((z - m_Box.lower[2]) * m_Box.Extent(1) + (y - m_Box.lower[1]));
  }

  std::uint32_t
  RunAt(const MedialVoxelIndex & index) const
  {
    if (m_Box.Contains(index))
    {
      const std::size_t   row = this->RowOf(index[1], index[2]);
      const std::uint64_t bit = std::uint64_t{ 1 } << (index[0] - m_Box.lower[0]);
      for (std::uint32_t run = m_FirstRun[row]; run < m_FirstRun[row + 1]; ++run)
      {
        if ((m_Runs[run].bits & bit) != 0)
        {
          return run;
        }
      }
    }
    throw std::out_of_range("MedialVoxelBoxComponents: a point is not a boundary point of the box");
  }

  std::uint32_t
  RootOf(std::uint32_t run) const;

  void
  Join(std::size_t row, std::size_t otherRow);

  MedialVoxelBox             m_Box;
  std::vector<std::uint32_t> m_FirstRun; // of each row, and one more
  std::vector<Run>           m_Runs;
};

} // end namespace itk

#endif
