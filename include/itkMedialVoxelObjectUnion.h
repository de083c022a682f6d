// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectUnion_h
#define itkMedialVoxelObjectUnion_h

#include "itkMedialVoxelObjectRegion.h"
#include "itkMedialVoxelTileResult.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

namespace itk
{

/** \class MedialVoxelObjectUnion
 * \brief Puts the results of the passes over a label map together, region by region.
 *
 * A cell of two objects belongs to the one for which it is medial, otherwise to the smaller one. The order of passes
 * changes nothing.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectUnion
{
public:
  /** \struct Cells
   * \brief Numbers of cells of an object.
   * \ingroup MedialVoxel
   */
  struct Cells
  {
    std::uint64_t candidate{ 0 };
    std::uint64_t medial{ 0 }; ///< also cells shared with other objects
  };

  /** \struct Values
   * \brief Results beside the labels. Each cell has the results of the object that it belongs to.
   * \ingroup MedialVoxel
   */
  struct Values
  {
    std::byte * first{ nullptr }; ///< of the voxels of the region, x fastest, all zero
    std::size_t bytesPerVoxel{ 0 };

    /** Writes the values of a tile to its voxels. */
    std::function<void(const MedialVoxelTileResult & tile, void * first, const MedialVoxelStrides & strides)> write;
  };

  /** Arguments as of MedialVoxelObjectRegion. */
  MedialVoxelObjectUnion(MedialVoxelObjectMap & map, const MedialVoxelIndex & size, std::uint64_t maximumPoreSize);

  /** Bytes of a voxel of the region. */
  static constexpr std::uint64_t BytesPerVoxel =
    MedialVoxelObjectRegion::BytesPerVoxel + sizeof(std::uint8_t) + sizeof(MedialVoxelObjectNumber);

  /** Begin with a region, before the first pass over it. */
  void
  Begin(const MedialVoxelBox & region, std::vector<Values> values);

  /** Take the results of the current pass in a tile. Called by several threads at a time. */
  void
  TakeTile(const MedialVoxelTileResult & tile);

  /** Take the results of the pass in filled pores, after all of its tiles. */
  void
  FinishPass();

  /** Finish the region after its last pass. */
  void
  Finish();

  /** The objects of the voxels of the region. */
  const MedialVoxelObjectRegion &
  GetRegion() const
  {
    return m_Region;
  }

  /** Of the voxels of the region, x fastest: the labels of cells, and the numbers of their objects. */
  const std::vector<std::uint8_t> &
  GetLabels() const
  {
    return m_Labels;
  }
  const std::vector<MedialVoxelObjectNumber> &
  GetObjects() const
  {
    return m_Objects;
  }

  /** \struct Sums
   * \brief Counts of cells of a region. A pass that runs again counts again.
   * \ingroup MedialVoxel
   */
  struct Sums
  {
    std::uint64_t                            shared{ 0 }; ///< medial for several objects
    std::map<MedialVoxelObjectNumber, Cells> cells;       ///< by object
  };

  const Sums &
  GetSums() const
  {
    return m_Sums;
  }

private:
  /** A cell without a corner in an object, which lies in a filled pore. */
  struct PoreCell
  {
    MedialVoxelIndex                    index;
    std::uint8_t                        label;
    std::vector<std::vector<std::byte>> values; ///< of each kind
  };

  /** Give a cell to an object, unless another one keeps it; valueOf(kind) has its values. No two threads have the same
   * cell.
   */
  template <typename TValueOf>
  void
  TakeCell(std::size_t             offset,
           std::uint8_t            label,
           MedialVoxelObjectNumber object,
           const TValueOf &        valueOf,
           Sums &                  sums);

  /** A bit of the labels of cells that are medial for several objects, until the region is finished. */
  static constexpr std::uint8_t SharedMark = 4;

  MedialVoxelObjectMap &               m_Map;
  MedialVoxelObjectRegion              m_Region;
  MedialVoxelBox                       m_Box;
  std::vector<Values>                  m_Values;
  std::vector<std::uint8_t>            m_Labels;
  std::vector<MedialVoxelObjectNumber> m_Objects;
  std::mutex                           m_Mutex; // of the members below
  Sums                                 m_Sums;
  std::vector<PoreCell>                m_PoreCells;
};

} // end namespace itk

#endif
