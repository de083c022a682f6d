// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelCellSample_h
#define medialvoxelCellSample_h

#include "itkMedialVoxelTileObserver.h"

#include <cstdint>

namespace medialvoxel
{

/** \class CellSample
 * \brief Chooses every n-th cell of a row by its place alone, so that samples do not depend on outputs or divisions.
 *
 * Where a row begins to count differs from row to row, so that no wall is missed whatever its direction. */
class CellSample
{
public:
  /** All cells. */
  CellSample() = default;

  /** So many cells that volumes of no more than \a fullVoxels have all of theirs: n is the least power of two that
   * leaves no more than that, at most 64. */
  CellSample(std::uint64_t voxels, std::uint64_t fullVoxels);

  /** One of how many cells is in the sample. */
  unsigned int
  GetStep() const
  {
    return m_Step;
  }

  bool
  Contains(const itk::MedialVoxelIndex & cell) const;

  /** The bits of the cells of a row. */
  itk::MedialVoxelBits::WordType
  Select(const itk::MedialVoxelCellRow & row) const;

private:
  /** Cells of the row at \a cell are in the sample where x is this number, modulo the step. */
  std::uint64_t
  GetPhase(const itk::MedialVoxelIndex & cell) const;

  unsigned int                   m_Step{ 1 };
  itk::MedialVoxelBits::WordType m_EveryStep{ ~itk::MedialVoxelBits::WordType{ 0 } }; ///< bits 0, step, 2 step ...
};

} // end namespace medialvoxel

#endif
