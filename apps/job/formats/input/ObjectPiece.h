// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectPiece_h
#define medialvoxelObjectPiece_h

#include "ObjectNumber.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelObjectRegion.h"

#include <cstdint>

namespace medialvoxel
{

/** \class ObjectPiece
 * \brief The objects of the voxels of some slices, and so those of the cells of these slices, by numbers of voxels. */
class ObjectPiece : public itk::MedialVoxelObjectRegion
{
public:
  /** \param maximumPoreSize of the extraction */
  ObjectPiece(itk::MedialVoxelObjectMap & map, const VolumeGeometry & geometry, std::uint64_t maximumPoreSize);

  /** Reads slices along the last axis, and the one that the last cells reach into. */
  void
  Read(std::uint64_t firstSlice, std::uint64_t endSlice);

  std::uint64_t
  GetFirstVoxel() const
  {
    return m_FirstVoxel;
  }

  using MedialVoxelObjectRegion::FindObject;
  using MedialVoxelObjectRegion::FindObjectOfPore;

  /** The object of a pass that a cell has a corner in; 0 when it has none.
   * \param voxel number of its lowest corner, in the slices that were read */
  ObjectNumber
  FindObject(std::uint64_t voxel, unsigned int pass) const
  {
    return this->FindObjectAt(voxel - m_FirstVoxel, pass);
  }

  /** The object with the filled pore that a cell lies in; 0 when there is none. */
  ObjectNumber
  FindObjectOfPore(std::uint64_t voxel, unsigned int pass) const;

  /** One or the other: of every cell that a pass has results for. Like the latter not for threads of the engine. */
  template <typename TCell>
  ObjectNumber
  FindOwner(const TCell & cell, unsigned int pass) const
  {
    const ObjectNumber object = this->FindObject(cell, pass);
    return object > 0 ? object : this->FindObjectOfPore(cell, pass);
  }

private:
  itk::MedialVoxelBox m_Image;
  unsigned int        m_LastAxis;
  std::uint64_t       m_VoxelsPerSlice;
  std::uint64_t       m_FirstVoxel{ 0 };
};

} // end namespace medialvoxel

#endif
