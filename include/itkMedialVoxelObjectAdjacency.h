// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectAdjacency_h
#define itkMedialVoxelObjectAdjacency_h

#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelLabelTable.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace itk
{

/** \class MedialVoxelLabelError
 * \brief An image is no label map.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelLabelError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** \class MedialVoxelObjectAdjacency
 * \brief Finds the pairs of objects of a label map that may change each other's result, and passes without these pairs.
 *
 * Two objects whose voxels are at least 4 apart along one axis share no boundary voxel, and no path on the boundary
 * leads from one to the other. When small pores are filled, none may lie in a pore of the other, so the reach grows
 * with the size of the pores. Objects in the same block or in neighboring blocks, as large as the reach, count as
 * close; this finds all pairs, and some more.
 *
 * Objects have numbers from 1 on; 0 is the background. Rows are added from the first to the last, x fastest.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectAdjacency
{
public:
  using ObjectType = MedialVoxelObjectNumber;

  /** \param size of the image, 1 along unused axes
   * \param maximumPoreSize voxels of the largest pores that are filled, 0 for none */
  MedialVoxelObjectAdjacency(const MedialVoxelIndex & size, std::uint64_t maximumPoreSize);

  /** Largest difference of indices, along any axis, of voxels that may influence each other. */
  static std::int64_t
  GetReach(const MedialVoxelIndex & size, std::uint64_t maximumPoreSize);

  /** Bytes of the blocks of an image of this size, if nearly none has more than MostInBlock objects. */
  static std::uint64_t
  GetBytes(const MedialVoxelIndex & size, std::uint64_t maximumPoreSize);

  /** More passes than any label map needs: an image full of objects of two voxels along each axis takes some dozens. */
  static constexpr std::size_t MostPasses = 128;

  /** Add the objects of the next row.
   * \throw MedialVoxelLabelError as soon as a group of objects that are all close to each other needs more than
   * MostPasses */
  void
  AddRow(const ObjectType * row);

  /** The pass of each object from 0 on, by number; no two close objects share a pass. Background has pass 0. The same
   * for any order of the pairs: the object with the fewest passes left comes first, then most neighbors, then the
   * smaller number; it gets the first free pass.
   * \param numberOfObjects not less than the largest number of a row
   * \throw MedialVoxelLabelError for more passes than MostPasses */
  std::vector<ObjectType>
  MakePasses(std::size_t numberOfObjects);

private:
  /** Objects of a block that are stored in place; a list for each of millions of blocks would take ten times the
   * memory.
   */
  static constexpr std::size_t MostInBlock = 4;

  /** The objects of blocks, each once. */
  struct Layer
  {
    std::vector<std::array<ObjectType, MostInBlock>>         first; ///< the first ones; 0: no more
    std::unordered_map<std::size_t, std::vector<ObjectType>> rest;
  };

  void
  AddObject(Layer & layer, std::size_t block, ObjectType object) const;

  template <typename TFunction>
  static void
  ForEachObject(const Layer & layer, std::size_t block, TFunction && function);

  void
  FinishLayer();

  /** Objects of a block and of its neighbors lower by up to 1 along each axis: all are close to each other. */
  void
  CheckPasses(std::int64_t blockX, std::int64_t blockY);

  [[noreturn]] void
  RefusePasses() const;

  void
  AddPair(ObjectType first, ObjectType second);

  /** Leaves each pair once, in ascending order. */
  void
  SortPairs();

  void
  Connect(std::size_t block, const Layer & otherLayer, std::size_t other);

  MedialVoxelIndex           m_Size;
  std::int64_t               m_BlockEdge;
  std::int64_t               m_BlocksX;
  std::int64_t               m_BlocksY;
  std::int64_t               m_NextY{ 0 };
  std::int64_t               m_NextZ{ 0 };
  Layer                      m_Layer;               ///< of blocks that rows are added to
  Layer                      m_PreviousLayer;       ///< the one before
  std::vector<std::uint32_t> m_Pairs;               ///< smaller number above, larger below; some more than once
  std::size_t                m_NumberOfSorted{ 0 }; ///< pairs, which are the first ones, when they were sorted
  std::vector<std::uint32_t> m_LastPairs;           ///< that came last, by a hash
};

} // end namespace itk

#endif
