// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileLabels_h
#define itkMedialVoxelTileLabels_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelParameters.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \struct MedialVoxelDiagonalNumbers
 * \brief The numbers of the diagonals that decide up to 64 cells of a row, bit 0 the first cell.
 * \ingroup MedialVoxel
 */
struct MedialVoxelDiagonalNumbers
{
  MedialVoxelBits::WordType lower{ 0 }; ///< the lower bits of the numbers, which are below 4
  MedialVoxelBits::WordType upper{ 0 }; ///< the upper bits

  /** The number of the cell \a x after the first, which had none before. */
  void
  Set(const int x, const unsigned int number)
  {
    lower |= MedialVoxelBits::WordType{ number & 1u } << x;
    upper |= MedialVoxelBits::WordType{ number >> 1 } << x;
  }

  unsigned int
  Get(const int x) const
  {
    return static_cast<unsigned int>(((lower >> x) & 1u) | (((upper >> x) & 1u) << 1));
  }
};

/** \struct MedialVoxelCellRow
 * \brief Up to 64 cells of a row as bits, bit 0 the first one.
 * \ingroup MedialVoxel
 */
struct MedialVoxelCellRow
{
  /** Memory of all rows of a tile, for each of its voxels, at most. */
  static constexpr std::uint64_t BytesPerVoxel = 2;

  MedialVoxelIndex          first{};         ///< index of the cell of bit 0
  MedialVoxelBits::WordType candidates{ 0 }; ///< cells with an object corner
  MedialVoxelBits::WordType byBound{ 0 };    ///< of them: medial by the bound
  MedialVoxelBits::WordType byGeodesic{ 0 }; ///< of them: medial by the search
  MedialVoxelBits::WordType measured{ 0 };   ///< of the medial ones: their walls are measured

  MedialVoxelDiagonalNumbers diagonals{}; ///< of the medial ones, at least
};

/** \class MedialVoxelTileLabels
 * \brief The labels of a tile while its cells are decided, and how many each phase decided.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileLabels
{
public:
  using WordType = MedialVoxelBits::WordType;

  /** \param labels  replaced, x fastest; NoObject at first
   * \param counts  added to
   * \param rows    null, or replaced by the rows with candidates */
  MedialVoxelTileLabels(const MedialVoxelBox &            tile,
                        std::vector<std::uint8_t> &       labels,
                        MedialVoxelCounts &               counts,
                        std::vector<MedialVoxelCellRow> * rows);

  const MedialVoxelBox &
  GetTile() const
  {
    return m_Tile;
  }

  std::size_t
  OffsetOf(const MedialVoxelIndex & cell) const
  {
    return m_Tile.OffsetOf(cell);
  }

  /** Cells of a row with an object corner; they are not medial until they are decided. All but the \a nontrivial ones
   * are trivial. */
  void
  AddCandidates(const MedialVoxelIndex & first, WordType candidates, WordType nontrivial);

  /** The diagonals of cells of the last AddCandidates(), which began at \a first. */
  void
  KeepDiagonals(const MedialVoxelIndex & first, const MedialVoxelDiagonalNumbers & diagonals);

  /** One more of the nontrivial cells is trivial after all. */
  void
  CountTrivialCell()
  {
    ++m_Counts.trivialCells;
  }

  void
  Decide(const std::size_t offset, const std::uint8_t label)
  {
    m_Labels[offset] = label;
    m_Counts.AddDecision(label);
  }

  /** Enter the labels into the rows, when all cells are decided. */
  void
  FinishRows();

private:
  MedialVoxelBox                    m_Tile;
  std::vector<std::uint8_t> &       m_Labels;
  MedialVoxelCounts &               m_Counts;
  std::vector<MedialVoxelCellRow> * m_Rows;
};

} // end namespace itk

#endif
