// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectUnion_h
#define medialvoxelObjectUnion_h

#include "JobPlan.h"
#include "LabelMap.h"
#include "ObjectPiece.h"
#include "OutputRequest.h"
#include "VoxelOutput.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** \class ObjectUnion
 * \brief Puts the results of the passes over a label map together, piece by piece.
 *
 * Of two objects that have a cell, that for which it is medial gets it, and otherwise the smaller label. */
class ObjectUnion
{
public:
  /** \param maximumPoreSize of the extraction */
  ObjectUnion(LabelMap & map, const VolumeGeometry & geometry, std::uint64_t maximumPoreSize);
  ~ObjectUnion();

  /** Bytes of a voxel of a piece, beside those of the results of a pass and of the volumes. */
  static constexpr std::uint64_t BytesPerVoxel = ObjectPiece::BytesPerVoxel + sizeof(ObjectNumber) + 1;

  /** A volume that gets the union; the labels first.
   * \return where the results of a pass go */
  VoxelOutput &
  AddVolume(const VolumeRequest & request, VoxelOutput & volume);

  /** A volume that gets the label of the object of each cell. */
  void
  AddObjects(const VolumeRequest & request, VoxelOutput & volume);

  /** Before the first pass over a piece. */
  void
  BeginPiece(const SliceRange & piece);

  void
  BeginPass(unsigned int pass)
  {
    m_Pass = pass;
  }

  /** After the last pass: writes the volumes. */
  void
  FinishPiece();

  const ObjectPiece &
  GetPiece() const
  {
    return m_Piece;
  }

  /** Cells that are medial for several objects. */
  std::uint64_t
  GetSharedCells() const
  {
    return m_SharedCells;
  }

private:
  class PassVolume;

  void
  TakeLabels(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const std::uint8_t * labels);

  bool
  TakeCell(std::uint64_t offset, std::uint8_t label);

  LabelMap &                               m_Map;
  std::uint64_t                            m_VoxelsPerSlice;
  ObjectPiece                              m_Piece;
  unsigned int                             m_Pass{ 0 };
  std::vector<std::unique_ptr<PassVolume>> m_Volumes; ///< the labels first
  VoxelOutput *                            m_ObjectVolume{ nullptr };
  PixelType                                m_ObjectType{ PixelType::UInt8 };
  std::vector<ObjectNumber>                m_Objects; ///< of the cells of the piece
  std::vector<std::uint8_t>                m_IsTaken; ///< of the cells of the results that came last
  std::uint64_t                            m_SharedCells{ 0 };
};

} // end namespace medialvoxel

#endif
