// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelClosedPores_h
#define itkMedialVoxelClosedPores_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace itk
{

/** \class MedialVoxelClosedPores
 * \brief Fills background components of faces that join: the pores that the cells of an object close.
 *
 * MedialVoxelSmallComponents takes voxels as connected at edges and corners, too. A pit that reaches the outside only
 * there is no pore to it, but a cavity to the cells around. Here a component of at most the given number of voxels,
 * joined at faces, becomes object when none of its voxels is at a face of the image.
 *
 * Slices arrive one after the other. A slice is done when as many slices after it are known as a pore has voxels.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelClosedPores
{
public:
  /** Fills components of at most \a maximumSize voxels; 0 fills nothing. */
  MedialVoxelClosedPores(const MedialVoxelGrid & grid, std::uint64_t maximumSize);

  /** Add the object voxels of the next slice. */
  void
  AddSlice(MedialVoxelBits object);

  /** Whether a slice is done that was not taken. */
  bool
  HasSlice() const
  {
    return m_FirstSlice < m_NumberDone;
  }

  /** Take the first slice that is done. */
  MedialVoxelBits
  TakeSlice();

private:
  const MedialVoxelBits &
  At(const std::int64_t slice) const
  {
    return m_Slices[static_cast<std::size_t>(slice - m_FirstSlice)];
  }

  bool
  IsBackground(const MedialVoxelIndex & voxel) const
  {
    return !this->At(voxel[2]).Test(voxel);
  }

  bool
  IsAtFace(const MedialVoxelIndex & voxel) const;

  void
  Invert(const MedialVoxelIndex & voxel);

  void
  FillFrom(std::int64_t slice);

  void
  FillIfSmall(const MedialVoxelIndex & seed);

  bool
  InvertComponent(const MedialVoxelIndex & seed);

  MedialVoxelBox                m_Image;
  std::uint64_t                 m_MaximumSize;
  std::deque<MedialVoxelBits>   m_Slices;
  MedialVoxelBits               m_Below; ///< the last slice that is done
  std::vector<MedialVoxelIndex> m_Component;
  std::int64_t                  m_FirstSlice{ 0 };
  std::int64_t                  m_NumberDone{ 0 };
  std::int64_t                  m_NumberOfSlices{ 0 };
};

} // end namespace itk

#endif
