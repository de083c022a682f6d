// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSmallComponents_h
#define itkMedialVoxelSmallComponents_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelSparseBits.h"

#include "MedialVoxelExport.h"

#include <cstdint>

namespace itk
{

/** \class MedialVoxelSmallComponents
 * \brief Fills pores and removes dust: components of at most so many voxels change sides.
 *
 * Voxels of one kind, object or background, are connected when they differ by at most 1 along each axis. First each
 * background component of at most the given number of voxels becomes object, then each object component of at most
 * that number becomes background. A component with a voxel at a face of the image stays: it may go on outside. Axes of
 * length 1 have no faces, and an image of a single voxel stays as it is.
 *
 * The result of a voxel depends on the voxels within GetMargin() alone. A component that reaches farther is too large.
 * A small object component cannot touch a pore that reaches farther: its surroundings are connected, so the pore would
 * enclose all of it and be too large. A row of voxels has two sides that are not connected, and twice the margin.
 *
 * Bits may be changed part by part in any order, beside parts that are done: filling a pore leaves all other background
 * components as they are, and removing dust only enlarges a component that stays.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSmallComponents
{
public:
  /** Changes components of at most \a maximumSize voxels; 0 changes nothing. Keeps a list of so many voxels. */
  MedialVoxelSmallComponents(const MedialVoxelGrid & grid, std::uint64_t maximumSize);

  /** False when nothing is ever changed. */
  bool
  IsOn() const
  {
    return m_MaximumSize > 0;
  }

  /** Voxels around a box that must be known, as far as the image has them. */
  const MedialVoxelIndex &
  GetMargin() const
  {
    return m_Margin;
  }

  /** Bytes taken meanwhile, beside the bits, for bits of \a box. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & box) const;

  /** Change the small components in \a box. The bits hold the box and its margin.
   *
   * \param changed has the box of \a object; the bits of the voxels that change are inverted */
  void
  Change(const MedialVoxelBox & box, MedialVoxelBits & object, MedialVoxelSparseBits & changed) const;

private:
  MedialVoxelGrid  m_Grid;
  std::uint64_t    m_MaximumSize;
  MedialVoxelIndex m_Margin;
};

} // end namespace itk

#endif
