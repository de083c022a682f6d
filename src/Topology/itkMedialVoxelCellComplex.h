// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelCellComplex_h
#define itkMedialVoxelCellComplex_h

#include "itkMedialVoxelBettiNumbers.h"
#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelRunComponents.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelCellComplex
 * \brief Counts the parts, tunnels and cavities of a set of cells.
 *
 * The complex of the cells has all faces of object voxels whose corners are in the set; see MedialVoxelCellLink. Parts
 * are its components. Cavities are the components of all else but one. The Euler number gives the tunnels.
 *
 * Slices arrive one after the other, and two of them are in memory.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelCellComplex
{
public:
  explicit MedialVoxelCellComplex(const MedialVoxelGrid & grid);

  /** Add the next slice.
   *
   * \param object  its voxels
   * \param next    those of the slice after it, without bits after the last one
   * \param cells   cells of the slice with an object corner */
  void
  AddSlice(const MedialVoxelBits & object, const MedialVoxelBits & next, const MedialVoxelBits & cells);

  /** Memory of the runs, which grows with noise. */
  std::uint64_t
  GetBytesOfRuns() const
  {
    return m_Parts.GetBytes() + m_Others.GetBytes();
  }

  /** Memory for a slice in \a box with a run for some 40 voxels. */
  static std::uint64_t
  GetUsualBytes(const MedialVoxelBox & box)
  {
    constexpr std::uint64_t rows = 13;
    constexpr std::uint64_t runsPerVoxel = 4;
    return rows * MedialVoxelBits::GetBytes(box) + runsPerVoxel * static_cast<std::uint64_t>(box.NumberOfVoxels());
  }

  /** Of all slices. */
  MedialVoxelBettiNumbers
  GetBettiNumbers() const;

private:
  using WordType = MedialVoxelBits::WordType;
  using Words = std::vector<WordType>;

  /** The words of the rows from -1 to the last one, and one zero beside each. */
  class Rows
  {
  public:
    void
    Reshape(std::int64_t numberOfRows, std::int64_t numberOfWords);

    WordType *
    At(const std::int64_t row)
    {
      return m_Words.data() + (row + 1) * m_Pitch + 1;
    }

  private:
    std::int64_t m_Pitch{ 0 };
    Words        m_Words;
  };

  void
  AddPlane();

  void
  AddLayer();

  void
  JoinCells();

  void
  JoinOthers();

  void
  Count(WordType faces, int sign)
  {
    m_EulerNumber += sign * MedialVoxelPopulationCount(faces);
  }

  MedialVoxelBox           m_Image;
  std::int64_t             m_NumberOfWords{ 0 };
  std::int64_t             m_EulerNumber{ 0 };
  MedialVoxelRunComponents m_Parts;
  MedialVoxelRunComponents m_Others;

  Rows m_Voxels; ///< of the slice
  Rows m_Around; ///< and of the one after it

  // Cells of the slice, of the one before, and the faces of the complex, at their lowest cell: edges by axis, squares
  // by the axis across, and cubes.
  Rows m_Cells, m_Before, m_EdgesX, m_EdgesY, m_EdgesZ, m_SquaresX, m_SquaresY, m_SquaresZ, m_SquaresBefore, m_Cubes;
};

} // end namespace itk

#endif
