// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectRegion_h
#define itkMedialVoxelObjectRegion_h

#include "itkMedialVoxelObjectMap.h"

#include "MedialVoxelExport.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelObjectRegion
 * \brief The objects of the voxels and cells of a region.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectRegion
{
public:
  /** \param map must outlive it
   * \param size of the image, 1 along unused axes */
  MedialVoxelObjectRegion(MedialVoxelObjectMap & map, const MedialVoxelIndex & size);

  /** Bytes of a voxel of the region and of the margin for its last cells. */
  static constexpr std::uint64_t BytesPerVoxel = sizeof(MedialVoxelObjectNumber);

  /** Read the voxels of a region, and one more along each axis for its last cells. */
  void
  Read(const MedialVoxelBox & region);

  /** The voxels that were read. */
  const MedialVoxelBox &
  GetBox() const
  {
    return m_Box;
  }

  /** The object of a pass at a corner of a cell; 0 without one. A cell never has two objects of a pass.
   * \param cell of the region */
  MedialVoxelObjectNumber
  FindObject(const MedialVoxelIndex & cell, const unsigned int pass) const
  {
    const MedialVoxelObjectNumber * const lowest = m_Objects.data() + m_Box.OffsetOf(cell);
    for (const std::size_t corner : m_Corners)
    {
      assert(lowest + corner < m_Objects.data() + m_Objects.size());
      const MedialVoxelObjectNumber object = lowest[corner];
      if (object > 0 && m_Map.GetPass(object) == pass)
      {
        return object;
      }
    }
    return 0;
  }

  /** For a cell without object corner: the object whose filled pore holds it. It surrounds the cell, and other objects
   * of the pass are farther from it than the pore is wide, so it is the nearest one. Reads the voxels around the cell,
   * so threads of the engine must not call it. */
  MedialVoxelObjectNumber
  FindObjectOfPore(const MedialVoxelIndex & cell, unsigned int pass) const;

  /** One or the other, for every cell with results of a pass. Threads of the engine must not call it either. */
  MedialVoxelObjectNumber
  FindOwner(const MedialVoxelIndex & cell, const unsigned int pass) const
  {
    const MedialVoxelObjectNumber object = this->FindObject(cell, pass);
    return object > 0 ? object : this->FindObjectOfPore(cell, pass);
  }

private:
  MedialVoxelObjectMap &               m_Map;
  MedialVoxelBox                       m_Image;
  MedialVoxelBox                       m_Box;
  std::vector<std::size_t>             m_Corners; ///< of a cell, from the lowest one
  std::vector<MedialVoxelObjectNumber> m_Objects;
};

} // end namespace itk

#endif
