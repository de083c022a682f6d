// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFilterAccess_h
#define itkMedialVoxelFilterAccess_h

#include "itkMedialVoxelSums.h"
#include "itkMedialVoxelTileObserver.h"

#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelFilterAccess
 * \brief Gives tests the parts of a filter that users do not need: the division of its work, its tiles and all sums.
 * \ingroup MedialVoxel
 */
class MedialVoxelFilterAccess
{
public:
  /** Edge in voxels of the tiles that threads work on; 0, the default, chooses. */
  template <typename TFilter>
  static void
  SetTileSize(TFilter & filter, const unsigned int tileSize)
  {
    filter.m_TileSize = tileSize;
    filter.Modified();
  }

  /** Voxels along the slowest axis that are processed between two pulls of input; 0, the default, chooses. */
  template <typename TFilter>
  static void
  SetSlabThickness(TFilter & filter, const unsigned int slabThickness)
  {
    filter.m_SlabThickness = slabThickness;
    filter.Modified();
  }

  /** Not owned, and must outlive the updates. */
  template <typename TFilter>
  static void
  SetTileObservers(TFilter & filter, std::vector<MedialVoxelTileObserver *> observers)
  {
    filter.m_TileObservers = std::move(observers);
    filter.Modified();
  }

  template <typename TFilter>
  static const MedialVoxelSums &
  GetSums(const TFilter & filter)
  {
    return filter.m_Sums;
  }
};

} // end namespace itk

#endif
