// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelMap_h
#define medialvoxelLabelMap_h

#include "InputVolume.h"

#include <cstdint>

namespace medialvoxel
{

/** \class LabelMap
 * \brief An opened volume with many objects, each with a value of its own. */
class LabelMap : public InputVolume
{
public:
  /** \param selection the values that are objects
   * \param maximumPoreSize of the extraction
   * \param bytesToKeep of chunks whose further slices are needed later */
  LabelMap(const VolumeHeader &   header,
           const LabelSelection & selection,
           std::uint64_t          maximumPoreSize,
           std::uint64_t          bytesToKeep);

  /** Reads all voxels once, from front to back: finds the objects and their passes.
   * \throw JobError CorruptInput for a number that is not whole or too many values; Usage for a selected
   * value that no voxel has */
  void
  Prepare(const ReadObserver & observer) override;

  itk::MedialVoxelObjectMap &
  GetObjects() const
  {
    return this->GetLabels();
  }

private:
  itk::MedialVoxelLabelInput &
  GetLabels() const
  {
    return static_cast<itk::MedialVoxelLabelInput &>(this->GetInput());
  }

  VolumeHeader m_Header;
};

} // end namespace medialvoxel

#endif
