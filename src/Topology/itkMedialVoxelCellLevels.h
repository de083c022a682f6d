// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelCellLevels_h
#define itkMedialVoxelCellLevels_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelFeatures.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelThinning.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelCellLevels
 * \brief Finds the levels of cells: how deep in the object their shallowest corner lies.
 *
 * The level is the smallest distance of a corner to its nearest boundary voxel, in smallest spacings, rounded down. It
 * is 0 where a corner is background, and NoLevel where the image has no boundary.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelCellLevels
{
public:
  using LevelType = MedialVoxelThinning::LevelType;

  static constexpr std::uint64_t BytesPerVoxel = sizeof(LevelType);

  explicit MedialVoxelCellLevels(const MedialVoxelGrid & grid);

  /** The levels of \a tile, x fastest.
   *
   * \param object    bits of the corners
   * \param features  displacements of the object voxels among them */
  void
  Compute(const MedialVoxelBox &      tile,
          const MedialVoxelBits &     object,
          const MedialVoxelFeatures & features,
          std::vector<LevelType> &    levels) const;

private:
  LevelType
  FindLevel(const MedialVoxelIndex & cell, const MedialVoxelFeatures & features) const;

  MedialVoxelGrid  m_Grid;
  MedialVoxelIndex m_Unit;
  double           m_SmallestSpacing; ///< in metric units
};

} // end namespace itk

#endif
