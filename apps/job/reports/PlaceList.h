// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceList_h
#define medialvoxelPlaceList_h

#include "PlaceSums.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class PlaceList
 * \brief The largest of the places that are complete, and sums over all of them.
 *
 * Memory is bounded: a place that is not among the largest now will not be later. */
class PlaceList
{
public:
  static constexpr std::size_t MostPlaces = 10000;

  /** Sums over places. */
  struct Totals
  {
    std::uint64_t number{ 0 };
    std::uint64_t cells{ 0 };
    std::uint64_t area{ 0 };
    std::uint64_t areaBeyond{ 0 };
    std::uint64_t smaller{ 0 }; ///< places that are too small, which nothing else here counts
  };

  /** Takes a place, unless no cell of it is beyond the first limit or the area of these is too small. */
  void
  Add(const PlaceSums & place, const PlaceRule & rule);

  const Totals &
  GetTotals() const
  {
    return m_Totals;
  }

  /** The largest area beyond the limit first, then by the keys of their worst cells. None are left. */
  std::vector<PlaceSums>
  TakeSorted();

  void
  Clear();

  void
  Save(NumberWriter & numbers) const;

  /** Merges the saved list of another process. \throw JobError Failure */
  void
  Merge(NumberReader & numbers);

private:
  void
  Keep(const PlaceSums & place);

  Totals                 m_Totals;
  std::vector<PlaceSums> m_Largest; ///< a heap, the smallest on top
};

} // end namespace medialvoxel

#endif
