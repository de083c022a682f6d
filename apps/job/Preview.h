// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPreview_h
#define medialvoxelPreview_h

#include "OutputVolume.h"

#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class SliceScores
 * \brief Finds the slices that show most of the medial cells while the labels pass by.
 *
 * A sheet that a slice cuts across is a line in it; a sheet that lies in the slice is a blot that shows little. The
 * score of a slice is therefore three times the length of the outline of its medial cells, counted at their lower
 * sides, minus their number: positive for lines of up to three cells across. */
class SliceScores
{
public:
  explicit SliceScores(const VolumeGeometry & geometry);

  /** Adds the labels of the next slices along the last axis; they must come in order. Images of two dimensions have
   * nothing to choose from. */
  void
  Add(std::uint64_t firstSlice, std::uint64_t numberOfSlices, const std::uint8_t * labels);

  /** As Add() of slices without labels. */
  void
  AddEmpty();

  /** Index of the slice across \a axis with the highest score among the inner nine tenths; the middle one when there
   * are no medial cells. */
  std::uint64_t
  GetBestSlice(unsigned int axis) const;

  /** True when the row along the first axis has a label other than zero. */
  bool
  HasLabels(std::uint64_t y, std::uint64_t z) const
  {
    return m_HasLabels[z * m_Geometry.size[1] + y];
  }

private:
  struct Rows;

  void
  AddRow(const Rows & rows, std::uint64_t y, std::uint64_t z);

  void
  AddCells(const Rows & rows, std::uint64_t begin, std::uint64_t end, std::uint64_t y, std::uint64_t z);

  VolumeGeometry                          m_Geometry;
  std::vector<std::vector<std::int64_t>>  m_Scores;    ///< by axis and index
  std::vector<std::vector<std::uint64_t>> m_Counts;    ///< of medial cells, likewise
  std::vector<bool>                       m_HasLabels; ///< by row, y faster than z
  std::vector<std::uint8_t>               m_LastSlice; ///< the slice before the next one; empty before the first
};

/** Memory of the above and of the below. */
std::uint64_t
GetPreviewBytes(const VolumeGeometry & geometry);

/** Draws the slices of a finished label volume with the best scores, and writes them as PNG: object gray, medial by
 * bound white, medial by geodesic red. The scale is the same in all slices and directions. Only the labels of these
 * slices are read. The picture has at most about 1600 pixels along its longer side.
 * \throw JobError Failure when the picture cannot be written */
void
WritePreview(const OutputVolume &   labels,
             const VolumeGeometry & geometry,
             const SliceScores &    scores,
             OutputFile &           file);

} // end namespace medialvoxel

#endif
