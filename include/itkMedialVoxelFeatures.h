// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFeatures_h
#define itkMedialVoxelFeatures_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** Displacement component of a voxel that has no nearest site. */
constexpr std::int32_t MedialVoxelNoDisplacement = std::numeric_limits<std::int32_t>::min();

/** \struct MedialVoxelFeatures
 * \brief Displacement in voxels from each voxel of a box to its nearest site.
 *
 * Voxels that were not requested have the displacement zero; voxels without a site within reach have
 * MedialVoxelNoDisplacement in every component.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelFeatures
{
  static constexpr std::uint64_t BytesPerVoxel = 3 * sizeof(std::int32_t);

  MedialVoxelBox            box;
  std::vector<std::int32_t> dx;
  std::vector<std::int32_t> dy;
  std::vector<std::int32_t> dz;

  /** Set the box and all displacements to zero. Clears only voxels marked since the last time. */
  void
  Reset(const MedialVoxelBox & newBox);

  /** Mark \a number voxels from \a offset on as written; all others must stay zero. */
  void
  MarkWritten(std::size_t offset, std::size_t number);

  std::size_t
  OffsetOf(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    return box.OffsetOf({ { x, y, z } });
  }

  bool
  HasSite(std::size_t offset) const
  {
    return dx[offset] != MedialVoxelNoDisplacement;
  }

private:
  struct Run
  {
    std::size_t offset;
    std::size_t number;
  };

  std::vector<Run> m_Written; ///< in ascending order
};

} // end namespace itk

#endif
