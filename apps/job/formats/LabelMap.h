// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelMap_h
#define medialvoxelLabelMap_h

#include "InputVolume.h"
#include "LabelTable.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** \class LabelMap
 * \brief An opened volume with many objects, each with a value of its own, which are shown in passes.
 *
 * Objects of a pass are so far apart that none changes the result of another. A volume that does not stream is unpacked
 * once, to two bytes per voxel in memory or in a scratch file. */
class LabelMap : public InputVolume
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
   * \throw JobError CorruptInput for a number that is not whole or more than MostObjects values; Usage for a selected
   * value that no voxel has */
  std::string
  Prepare(const ReadObserver & observer) override;

  const LabelTable &
  GetTable() const
  {
    return m_Table;
  }

  /** Voxels of each object, by its number. */
  const std::vector<std::uint64_t> &
  GetObjectVoxels() const
  {
    return m_ObjectVoxels;
  }

  unsigned int
  GetNumberOfPasses() const
  {
    return m_NumberOfPasses;
  }

  /** Pass of an object, from 0 on. */
  unsigned int
  GetPass(ObjectNumber object) const
  {
    return m_Passes[object];
  }

  /** Shows the objects of a pass from now on. */
  void
  ShowPass(unsigned int pass)
  {
    m_ShownPass = pass;
  }

  /** Reads the objects of a box, x fastest. */
  void
  ReadObjects(const itk::MedialVoxelBox & box, ObjectNumber * objects);

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

  VolumeHeader               m_Header;
  LabelSelection             m_Selection;
  std::uint64_t              m_MaximumPoreSize;
  std::unique_ptr<Source>    m_Source;
  LabelTable                 m_Table;
  std::vector<ObjectNumber>  m_Passes; ///< by object
  std::vector<std::uint64_t> m_ObjectVoxels;
  std::uint64_t              m_NotANumberVoxels{ 0 };
  unsigned int               m_NumberOfPasses{ 0 };
  unsigned int               m_ShownPass{ 0 };
};

} // end namespace medialvoxel

#endif
