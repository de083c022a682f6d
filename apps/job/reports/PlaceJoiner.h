// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceJoiner_h
#define medialvoxelPlaceJoiner_h

#include "PlaceList.h"
#include "PlaceSums.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace medialvoxel
{

/** \class PlaceJoiner
 * \brief Joins neighbors among the cells of a volume to places, while its regions come one after the other.
 *
 * Cells are neighbors when they share a corner. Regions come by slices, or by rows of slices. Between two regions it
 * keeps the cells that may get neighbors, and the largest finished places. The places do not depend on the regions. */
class PlaceJoiner
{
public:
  /** Bytes of a cell of a region while it is added, at most. */
  static constexpr std::uint64_t CellSize = 128;

  /** Bytes of a cell that is kept, and of a place that is, while a region is added. */
  static constexpr std::uint64_t OpenCellSize = 64;
  static constexpr std::uint64_t OpenPlaceSize = 3 * sizeof(PlaceSums);

  PlaceJoiner(const PlaceRule & rule, const PlaceGrid & grid);

  const PlaceRule &
  GetRule() const
  {
    return m_Rule;
  }

  /** Adds the cells of a region. The first one after Clear() may be any; slices before it belong to others. */
  void
  Add(const std::deque<PlaceCell> & cells, const itk::MedialVoxelBox & region);

  /** Bytes that are kept, while a region is added. */
  std::uint64_t
  GetOpenMemory() const
  {
    return m_OpenCells.size() * OpenCellSize + m_OpenPlaces.size() * OpenPlaceSize;
  }

  void
  Clear();

  /** Saves slices that will be joined with others, before and behind. */
  void
  Save(NumberWriter & numbers) const;

  /** Adds the slices that follow, from another one with the same arguments. \throw JobError Failure */
  void
  Merge(NumberReader & numbers);

  /** Nothing follows: all places are complete. */
  PlaceList
  Finish() const;

private:
  /** A joined cell: of an open place, or one of the new cells, whose numbers follow those of the places. */
  struct Node
  {
    std::int64_t  key;
    std::uint32_t number;
  };
  using Nodes = std::vector<Node>;

  template <typename TIsOpen>
  void
  Join(Nodes nodes, const std::vector<PlaceSums> & places, const std::deque<PlaceCell> & cells, const TIsOpen & isOpen);

  std::vector<std::uint32_t>
  FindRoots(const Nodes & nodes, std::size_t numberOfPlaces) const;

  PlaceRule              m_Rule;
  PlaceGrid              m_Grid;
  std::int64_t           m_FirstSlice{ -1 }; ///< -1: there was no region
  std::int64_t           m_EndSlice{ 0 };
  Nodes                  m_OpenCells;  ///< sorted by their keys; numbers of their places
  std::vector<PlaceSums> m_OpenPlaces; ///< each has an open cell
  PlaceList              m_Complete;
};

} // end namespace medialvoxel

#endif
