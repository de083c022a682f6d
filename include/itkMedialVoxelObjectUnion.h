// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectUnion_h
#define itkMedialVoxelObjectUnion_h

#include "itkMedialVoxelObjectRegion.h"
#include "itkMedialVoxelSameTopology.h"
#include "itkMedialVoxelTileResult.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace itk
{

/** \class MedialVoxelObjectUnion
 * \brief Puts the results of the passes over a label map together, region by region.
 *
 * A cell of two objects belongs to the one for which it is medial, then to the one whose topology needs it, otherwise
 * to the smaller one. The order of passes changes nothing.
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
    std::uint64_t added{ 0 };  ///< the same, for the topology

    Cells &
    operator+=(const Cells & other)
    {
      candidate += other.candidate;
      medial += other.medial;
      added += other.added;
      return *this;
    }
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

  /** Let each pass complete the topology of its objects in the whole image, which is the region then; unset: not. No
   * tile comes again. */
  void
  CompleteTopology(const std::optional<MedialVoxelGrid> & grid)
  {
    m_Grid = grid;
  }

  /** Begin with a region, before the first pass over it. */
  void
  Begin(const MedialVoxelBox & region, std::vector<Values> values);

  /** Begin with a region whose passes were put together, from its labels before Finish() and its objects. */
  void
  BeginAgain(const MedialVoxelBox &               region,
             std::vector<std::uint8_t>            labels,
             std::vector<MedialVoxelObjectNumber> objects);

  /** Take the results of the current pass in a tile. Called by several threads at a time. */
  void
  TakeTile(const MedialVoxelTileResult & tile);

  /** Take cells that the current pass adds for the topology, in a part of the region. */
  void
  TakeAddedCells(const MedialVoxelBits & added)
  {
    m_AddedCells.push_back(added);
  }

  /** Take the results of the pass in filled pores, and the added cells, after all of its tiles. */
  void
  FinishPass();

  /** Finish the region after its last pass. */
  void
  Finish()
  {
    RemoveMarks(m_Labels);
  }

  /** Leave labels alone where Finish() was not called. */
  static void
  RemoveMarks(std::vector<std::uint8_t> & labels);

  /** The objects of the voxels of the region. */
  const MedialVoxelObjectRegion &
  GetRegion() const
  {
    return m_Region;
  }

  /** Of the voxels of the region, x fastest: the labels of cells, with marks until Finish(), and the numbers of their
   * objects. */
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
    std::uint64_t                            shared{ 0 }; ///< of the sheets of several objects
    std::map<MedialVoxelObjectNumber, Cells> cells;       ///< by object
    MedialVoxelTopologySums                  topology;    ///< of all objects, where it was completed

    Sums &
    operator+=(const Sums & other);
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

  /** The same, without counts and values.
   * \return whether the object has the cell now, and had not before */
  bool
  Give(std::size_t offset, std::uint8_t label, MedialVoxelObjectNumber object, Sums & sums);

  void
  GiveAddedCells(const MedialVoxelBits & added);

  void
  BeginTopology();

  /** A bit of the labels of cells that are in the sheets of several objects, until the region is finished. */
  static constexpr std::uint8_t SharedMark = 8;

  MedialVoxelObjectMap &               m_Map;
  MedialVoxelObjectRegion              m_Region;
  std::uint64_t                        m_MaximumPoreSize;
  std::optional<MedialVoxelGrid>       m_Grid; ///< set: the topology is completed
  MedialVoxelBox                       m_Box;
  std::vector<Values>                  m_Values;
  std::vector<std::uint8_t>            m_Labels;
  std::vector<MedialVoxelObjectNumber> m_Objects;
  std::mutex                           m_Mutex; // of the members below
  Sums                                 m_Sums;
  std::vector<PoreCell>                m_PoreCells;

  std::unique_ptr<MedialVoxelSameTopology> m_Topology; ///< of the objects of the pass
  std::vector<MedialVoxelBits>             m_AddedCells;
};

} // end namespace itk

#endif
