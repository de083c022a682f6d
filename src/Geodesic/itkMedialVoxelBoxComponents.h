// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBoxComponents_h
#define itkMedialVoxelBoxComponents_h

#include "itkMedialVoxelBits.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
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
    return this->RootOf(this->RunAt(a)) == this->RootOf(this->RunAt(b));
  }

private:
  /** Points of a row, as bits from the beginning of the box on. */
  struct Run
  {
    std::uint64_t bits;
    std::uint32_t parent;
  };

  std::size_t
  RowOf(const std::int64_t y, const std::int64_t z) const
  {
    return static_cast<std::size_t>((z - m_Box.lower[2]) * m_Box.Extent(1) + (y - m_Box.lower[1]));
  }

  std::uint32_t
  RunAt(const MedialVoxelIndex & index) const;

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
