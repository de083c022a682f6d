// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelCellPairs_h
#define itkMedialVoxelCellPairs_h

#include "itkMedialVoxelDualCell.h"
#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelPairChoice.h"
#include "itkMedialVoxelPairDecision.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace itk
{

/** \struct MedialVoxelCells
 * \brief Up to 64 cells of a row, bit 0 the first one.
 * \ingroup MedialVoxel
 */
struct MedialVoxelCells
{
  MedialVoxelIndex          first{};
  std::int64_t              number{ 0 };
  MedialVoxelBits::WordType candidates{ 0 }; ///< cells with an object corner
  std::size_t               offset{ 0 };     ///< of the features of the first cell
  MedialVoxelCornerRows     corners{};       ///< of solid volumes

  /** The diagonals with the widest angles, or -1 where these are not known yet. */
  std::array<std::int8_t, MedialVoxelBits::BitsPerWord> widest;
};

/** \struct MedialVoxelDiagonal
 * \brief The diagonal of a cell whose boundary points are seen under the widest angle, and these points.
 * \ingroup MedialVoxel
 */
struct MedialVoxelDiagonal
{
  unsigned int    number;
  MedialVoxelPair pair;
};

/** \class MedialVoxelCellPairs
 * \brief Finds the cells of a tile and, for each, the pair of boundary points that decides it.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelCellPairs
{
public:
  /** Pairs that are joined by an edge shorter than \a epsilon are trivial. */
  MedialVoxelCellPairs(const MedialVoxelGrid & grid, double epsilon);

  const MedialVoxelDualCell &
  GetCell() const
  {
    return m_Cell;
  }

  /** Call \a visit(cells) for the cells of \a box, in the order x, y, z, in groups that have a candidate, until it
   * returns false.
   *
   * \param object    bits of all corners
   * \param features  displacements of all corners
   * \return false when a visit did */
  template <typename TVisitor>
  bool
  Visit(const MedialVoxelBits &     object,
        const MedialVoxelFeatures & features,
        const MedialVoxelBox &      box,
        TVisitor &&                 visit) const
  {
    const MedialVoxelBox cellBox = box.Intersection(m_Grid.GetCellBox());
    MedialVoxelCells     cells;
    for (std::int64_t z = cellBox.lower[2]; z < cellBox.upper[2]; ++z)
    {
      for (std::int64_t y = cellBox.lower[1]; y < cellBox.upper[1]; ++y)
      {
        for (std::int64_t word = cellBox.lower[0] >> 6; word <= (cellBox.upper[0] - 1) >> 6; ++word)
        {
          if (this->Find(object, features, cellBox, word, y, z, cells) && !visit(cells))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  /** Cells of a row from \a first on, without their diagonals; prefetches the displacements of the cells in \a
   * asked. */
  MedialVoxelCells
  CellsFrom(const MedialVoxelFeatures & features,
            const MedialVoxelIndex &    first,
            MedialVoxelBits::WordType   asked) const;

  /** The only cell of a group. */
  MedialVoxelCells
  CellAt(const MedialVoxelFeatures & features, const MedialVoxelIndex & cell) const;

  /** The nearest boundary points of the corners of the cell \a x after the first; as many as the cell has corners. */
  void
  GetPoints(const MedialVoxelFeatures &       features,
            const MedialVoxelCells &          cells,
            int                               x,
            std::array<MedialVoxelIndex, 8> & points) const;

  /** The candidates that may have a nontrivial diagonal; finds their widest diagonals. */
  MedialVoxelBits::WordType
  FindNontrivial(MedialVoxelCells & cells) const;

  /** The diagonal of the cell \a x after the first, which FindNontrivial() found; false when its pair is trivial or
   * there is none. */
  bool
  Choose(const MedialVoxelFeatures & features,
         const MedialVoxelCells &    cells,
         int                         x,
         MedialVoxelDiagonal &       widest) const;

private:
  MedialVoxelCells
  GroupAt(const MedialVoxelFeatures & features, const MedialVoxelIndex & first) const;

  int
  SmallestKey(const MedialVoxelFeatures & features, std::size_t offset) const;

  std::size_t
  OffsetOf(const MedialVoxelFeatures & features, std::size_t offset, unsigned int corner) const;

  void
  FindWidest(MedialVoxelBits::WordType asked, MedialVoxelCells & cells) const;

  bool
  Find(const MedialVoxelBits &     object,
       const MedialVoxelFeatures & features,
       const MedialVoxelBox &      box,
       std::int64_t                word,
       std::int64_t                y,
       std::int64_t                z,
       MedialVoxelCells &          cells) const;

  MedialVoxelGrid     m_Grid;
  MedialVoxelDualCell m_Cell;
  double              m_Epsilon;
  bool                m_HasCornerRows;
};

} // end namespace itk

#endif
