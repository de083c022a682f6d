// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPassCells_h
#define medialvoxelPassCells_h

#include "ScratchFile.h"
#include "VoxelOutput.h"

#include "itkMedialVoxelObjectUnion.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace medialvoxel
{

/** \class PassCells
 * \brief All cells of the passes over a label map, and what the passes found together, in a scratch file. */
class PassCells
{
public:
  using ObjectNumber = itk::MedialVoxelObjectNumber;

  /** Bytes of a voxel in the file: of what was put together, and of each pass. */
  static constexpr std::uint64_t BytesOfUnion = sizeof(std::uint8_t) + sizeof(ObjectNumber);
  static constexpr std::uint64_t BytesOfPass = sizeof(std::uint16_t);

  /** \throw JobError Refused when the folder has no space for them, unless \a isSparse */
  PassCells(const std::filesystem::path & folder,
            const itk::MedialVoxelBox &   image,
            unsigned int                  numberOfPasses,
            bool                          isSparse);

  void
  BeginPass(const itk::MedialVoxelBox & region, unsigned int pass);

  /** Called by several threads at a time. */
  void
  TakeTile(const itk::MedialVoxelTileResult & tile);

  void
  FinishPass();

  /** A slice of a pass. */
  void
  ReadPass(unsigned int pass, std::uint64_t slice, std::vector<std::uint16_t> & cells) const;

  /** A region of voxels that follow each other. */
  void
  WriteUnion(const itk::MedialVoxelBox & region, const itk::MedialVoxelObjectUnion & united);

  /** A slice. */
  void
  ReadUnion(std::uint64_t slice, std::vector<std::uint8_t> & labels, std::vector<ObjectNumber> & objects) const;

private:
  std::uint64_t
  PlaceOfObjects(const std::uint64_t voxel) const
  {
    return m_Voxels + voxel * sizeof(ObjectNumber);
  }

  std::uint64_t
  PlaceOfPass(const unsigned int pass, const std::uint64_t voxel) const
  {
    return BytesOfUnion * m_Voxels + BytesOfPass * (pass * m_Voxels + voxel);
  }

  itk::MedialVoxelBox        m_Image;
  std::uint64_t              m_Voxels;
  std::uint64_t              m_PerSlice;
  ScratchFile                m_File;
  itk::MedialVoxelBox        m_Region;
  unsigned int               m_Pass{ 0 };
  std::vector<std::uint16_t> m_Cells; ///< of the pass in the region
};

/** Writes the labels of objects, slice by slice.
 * \param objects of the voxels from \a firstVoxel on */
void
WriteObjectValues(const std::vector<itk::MedialVoxelObjectNumber> & objects,
                  const itk::MedialVoxelLabelTable &                table,
                  PixelType                                         type,
                  std::size_t                                       perSlice,
                  std::uint64_t                                     firstVoxel,
                  VoxelOutput &                                     output);

} // end namespace medialvoxel

#endif
