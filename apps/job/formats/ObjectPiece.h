// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectPiece_h
#define medialvoxelObjectPiece_h

#include "LabelMap.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class ObjectPiece
 * \brief The objects of the voxels of some slices, and so those of the cells of these slices. */
class ObjectPiece
{
public:
  /** \param maximumPoreSize of the extraction */
  ObjectPiece(LabelMap & map, const VolumeGeometry & geometry, std::uint64_t maximumPoreSize);

  /** Bytes of a voxel of the slices, and of one slice more. */
  static constexpr std::uint64_t BytesPerVoxel = sizeof(ObjectNumber);

  /** Reads slices along the last axis, and the one that the last cells reach into. */
  void
  Read(std::uint64_t firstSlice, std::uint64_t endSlice);

  std::uint64_t
  GetFirstVoxel() const
  {
    return m_FirstVoxel;
  }

  /** The object of a pass that a cell has a corner in; 0 when it has none. Two objects of a pass are never in one cell.
   * \param voxel number of its lowest corner, in the slices that were read */
  ObjectNumber
  FindObject(std::uint64_t voxel, unsigned int pass) const
  {
    assert(voxel >= m_FirstVoxel);
    const ObjectNumber * const lowest = m_Objects.data() + (voxel - m_FirstVoxel);
    for (const std::size_t corner : m_Corners)
    {
      assert(lowest + corner < m_Objects.data() + m_Objects.size());
      const ObjectNumber object = lowest[corner];
      if (object > 0 && m_Map.GetPass(object) == pass)
      {
        return object;
      }
    }
    return 0;
  }

  /** The same for the index of the cell. */
  ObjectNumber
  FindObject(const itk::MedialVoxelIndex & cell, unsigned int pass) const
  {
    return this->FindObject(static_cast<std::uint64_t>(m_Image.OffsetOf(cell)), pass);
  }

  /** The object with the filled pore that a cell without a corner in an object lies in; 0 when there is none. Reads the
   * voxels around it, so that it must not be called from threads of the engine. */
  ObjectNumber
  FindObjectOfPore(std::uint64_t voxel, unsigned int pass) const;
  ObjectNumber
  FindObjectOfPore(const itk::MedialVoxelIndex & cell, unsigned int pass) const
  {
    return this->FindObjectOfPore(static_cast<std::uint64_t>(m_Image.OffsetOf(cell)), pass);
  }

  /** One or the other: of every cell that a pass has results for. Like the latter not for threads of the engine. */
  template <typename TCell>
  ObjectNumber
  FindOwner(const TCell & cell, unsigned int pass) const
  {
    const ObjectNumber object = this->FindObject(cell, pass);
    return object > 0 ? object : this->FindObjectOfPore(cell, pass);
  }

private:
  LabelMap &                m_Map;
  std::uint64_t             m_MaximumPoreSize;
  itk::MedialVoxelBox       m_Image;
  unsigned int              m_LastAxis;
  std::uint64_t             m_VoxelsPerSlice;
  std::vector<std::size_t>  m_Corners; ///< from the lowest one
  std::vector<ObjectNumber> m_Objects;
  std::uint64_t             m_FirstVoxel{ 0 };
};

} // end namespace medialvoxel

#endif
