// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelMap_h
#define medialvoxelLabelMap_h

#include "InputVolume.h"
#include "ObjectNumber.h"

#include "itkMedialVoxelObjectMap.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** \class LabelMap
 * \brief An opened volume with many objects, each with a value of its own, which are shown in passes.
 *
 * A volume that does not stream is unpacked once, to two bytes per voxel in memory or in a scratch file. */
class LabelMap
  : public InputVolume
  , public itk::MedialVoxelObjectMap
{
public:
  /** Bits per voxel that unpacking takes. */
  static constexpr std::uint64_t UnpackedBits = 16;

  /** \param selection the values that are objects
   * \param maximumPoreSize of the extraction
   * \param scratchFolder for a volume that does not stream; empty: in memory
   * \param bytesToKeep of chunks whose further slices are needed later
   * \param keepsVoxels false to find the objects and read no voxel after that, for which nothing is unpacked
   * \throw JobError Refused when there is no space in the scratch folder. */
  LabelMap(const VolumeHeader &          header,
           const LabelSelection &        selection,
           std::uint64_t                 maximumPoreSize,
           const std::filesystem::path & scratchFolder,
           std::uint64_t                 bytesToKeep,
           bool                          keepsVoxels = true);
  ~LabelMap() override;

  /** Reads all voxels once: finds the objects and their passes.
   * \throw JobError CorruptInput for a number that is not whole or too many values; Usage for a selected
   * value that no voxel has */
  std::string
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

  class Source;
  class StreamedSource;
  class UnpackedSource;

  VolumeHeader            m_Header;
  LabelSelection          m_Selection;
  std::uint64_t           m_MaximumPoreSize;
  std::unique_ptr<Source> m_Source;
  std::uint64_t           m_NotANumberVoxels{ 0 };
};

} // end namespace medialvoxel

#endif
