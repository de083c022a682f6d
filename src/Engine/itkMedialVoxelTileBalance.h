// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileBalance_h
#define itkMedialVoxelTileBalance_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <map>
#include <vector>

namespace itk
{

/** \class MedialVoxelTileBalance
 * \brief The order of the tiles of a slab, and the parts of long ones, so that threads end together.
 *
 * Most tiles take as long as the tile at the same place in the slab before. Order and parts have no influence on
 * results.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileBalance
{
public:
  /** From so many workers on, tiles are split: parts repeat work of the halo, and fewer workers lose time by that. */
  static constexpr unsigned int ManyWorkers = 8;

  /** A slab, without its tiles. */
  struct Slab
  {
    unsigned int slowestAxis{ 2 };
    unsigned int numberOfWorkers{ 1 };
    bool         wasDeferred{ false }; ///< of tiles that needed more than others: they take long
    bool         isLast{ false };      ///< threads find nothing else when they are done with it
  };

  /** Remember the seconds that a tile took. */
  void
  Record(const MedialVoxelBox & tile, unsigned int slowestAxis, double seconds);

  /** The tiles, in parts where many threads would have to wait for the last of them. Very long tiles come first and
   * short ones last, so that threads end together; others keep their order, because neighbors share caches. */
  std::vector<MedialVoxelBox>
  Balance(const std::vector<MedialVoxelBox> & tiles, const Slab & slab) const;

  /** Parts of \a tile of nearly equal size, at most \a number, and the tile as a whole where parts would be too small.
   */
  static std::vector<MedialVoxelBox>
  Split(const MedialVoxelBox & tile, std::int64_t number);

private:
  struct TimedTile
  {
    double         seconds; // that it will probably take; 0: nothing is known
    MedialVoxelBox box;
  };

  std::vector<TimedTile>
  Time(const std::vector<MedialVoxelBox> & tiles, unsigned int slowestAxis) const;

  static double
  SumOf(const std::vector<TimedTile> & tiles);

  /** Tiles of at most so many seconds come last. Together they take long enough to level threads that end with tiles of
   * up to \a longest seconds. */
  static double
  FindLongestTrailing(const std::vector<TimedTile> & tiles, double longest, double numberOfWorkers);

  /** Put very long tiles first, longest first, and short ones last; others keep their order. */
  static void
  Order(std::vector<TimedTile> & tiles, double numberOfWorkers);

  std::map<MedialVoxelIndex, double> m_VoxelSeconds; // of the last tile at a place within the slabs
};

} // end namespace itk

#endif
