// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRunComponents_h
#define itkMedialVoxelRunComponents_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelDisjointSets.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelRunComponents
 * \brief Counts the components of a graph on the points of a grid, row by row.
 *
 * Points of a row that links join are a run. Only the runs of two slices are in memory.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelRunComponents
{
public:
  using WordType = MedialVoxelBits::WordType;

  /** Of a row, a bit for each point. Links join points of the row. */
  struct Row
  {
    const WordType * points;
    const WordType * toNext;  ///< the point at x + 1
    const WordType * toRow;   ///< the point at x of the row before
    const WordType * toSlice; ///< the point at x of the slice before
  };

  /** Begin a slice of the image. */
  void
  BeginSlice();

  /** Add the next row of the slice, of so many words. */
  void
  AddRow(const Row & row, std::int64_t numberOfWords);

  /** Of all rows added. */
  std::int64_t
  GetNumberOfComponents() const
  {
    return m_NumberOfComponents;
  }

  /** Memory of the runs. */
  std::uint64_t
  GetBytes() const
  {
    return (m_Own.runs.capacity() + m_Before.runs.capacity()) * sizeof(Run) + m_Components.GetBytes();
  }

private:
  struct Run
  {
    std::int64_t begin;
    std::int64_t last;
    std::size_t  component;
  };

  /** Runs of all rows of a slice. */
  struct Slice
  {
    std::vector<Run>         runs;
    std::vector<std::size_t> ends; ///< of the rows
  };

  void
  Join(Run & a, const Run & b);

  void
  JoinRows(std::size_t first, const Slice & other, std::size_t row, const WordType * links);

  Slice                                m_Own;
  Slice                                m_Before;
  MedialVoxelDisjointSets<std::size_t> m_Components;
  std::int64_t                         m_NumberOfComponents{ 0 };
};

} // end namespace itk

#endif
