// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetPart_h
#define itkMedialVoxelSheetPart_h

#include "itkMedialVoxelRemeshedSheet.h"

namespace itk
{

/** A part of a sheet with larger triangles. */
struct MedialVoxelCoarsenedPart
{
  MedialVoxelSheet                     sheet;
  std::vector<MedialVoxelSheet::Index> finePoint; ///< of each point, one of the part that is near; itself if shared
  std::vector<bool>                    isShared;  ///< of each point
};

/** Lets triangles of a part of a sheet grow, where shared points stay as they are. Parts that are done apart fit
 * together again: no side between shared points is cut, taken away or made.
 * \param part     as that of MedialVoxelRemesh()
 * \param isShared of each point, whether other parts have it, too
 * \param most     length of sides that triangles get at most; 0: they stay as they are
 * \param noise    as that of MedialVoxelElementSize
 * \param progress called often with the share that is done; may throw to stop */
MedialVoxelCoarsenedPart
MedialVoxelCoarsenPart(MedialVoxelSheet                    part,
                       std::vector<bool>                   isShared,
                       const MedialVoxelElementSize &      size,
                       double                              most,
                       const std::function<void(double)> & progress);

} // end namespace itk

#endif
