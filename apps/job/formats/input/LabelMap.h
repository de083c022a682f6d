// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelMap_h
#define medialvoxelLabelMap_h

#include "InputVolume.h"
#include "ObjectNumber.h"
#include "ReaderPool.h"

#include "itkMedialVoxelObjectMap.h"

#include <cstdint>

namespace medialvoxel
{

/** \class LabelMap
 * \brief An opened volume with many objects, each with a value of its own, which are shown in passes. */
class LabelMap
  : public InputVolume
  , public itk::MedialVoxelObjectMap
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

  void
  ReadObjects(const itk::MedialVoxelBox & box, ObjectNumber * objects) override;

  std::uint64_t
  GetNumberOfNotANumberVoxels() const override
  {
    return m_NotANumberVoxels;
  }

  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override;

  std::uint64_t
  GetNumberOfBytesRead() const override;

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override;

private:
  void
  FillPart(const itk::MedialVoxelBox & part, itk::MedialVoxelBits & bits);

  /** Calls function(values, count). */
  template <typename TFunction>
  void
  WithValues(const itk::MedialVoxelBox & part, TFunction && function);

  /** Shows all values to a survey. */
  void
  Show(itk::MedialVoxelLabelSurvey & survey, const ReadObserver & observer);

  void
  Translate(const itk::MedialVoxelBox & part, ObjectNumber * objects);

  VolumeHeader   m_Header;
  LabelSelection m_Selection;
  std::uint64_t  m_MaximumPoreSize;
  ReaderPool     m_Readers;
  std::uint64_t  m_NotANumberVoxels{ 0 };
};

} // end namespace medialvoxel

#endif
