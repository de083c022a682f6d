// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileResult_h
#define itkMedialVoxelTileResult_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelFeatures.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

struct MedialVoxelCellRow;
struct MedialVoxelWall;

/** \class MedialVoxelTileResult
 * \brief What was found in a tile, which is as long at hand as the tile is being taken. What was not asked for is null.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileResult
{
public:
  MedialVoxelBox box;

  /** No cell has an object corner: all labels, vectors and thicknesses are zero, and nothing else is set. */
  bool isEmpty{ false };

  /** Labels of the cells, x fastest. */
  const std::uint8_t * labels{ nullptr };

  /** Displacements to the nearest boundary voxels, in a box that holds the tile. */
  const MedialVoxelFeatures * displacements{ nullptr };

  /** Object bits in a box that holds the tile. */
  const MedialVoxelBits * object{ nullptr };

  /** The cells whose walls were measured, and the walls. */
  const std::vector<MedialVoxelCellRow> * rows{ nullptr };
  const std::vector<MedialVoxelWall> *    walls{ nullptr };

  /** Write the thickness of the measured walls, negative at rims, to their cells in a buffer in which the tile begins
   * at \a first; other cells are left as they are. */
  void
  WriteThickness(float * first, const std::array<std::int64_t, 3> & strides) const;
};

} // end namespace itk

#endif
