// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetPart_h
#define itkMedialVoxelSheetPart_h

#include "itkMedialVoxelElementSize.h"
#include "itkMedialVoxelSheet.h"
#include "itkMedialVoxelWallsLeftOut.h"

#include <functional>

namespace itk
{

/** A sheet, or a part of one, with larger triangles; its points are of the given one. */
struct MedialVoxelCoarsenedPart
{
  MedialVoxelSheet                     sheet;
  std::vector<MedialVoxelSheet::Index> finePoint; ///< of each point, its number in the given one
  std::uint64_t                        walls{ 0 };
  std::vector<MedialVoxelWallLeftOut>  wallsLeftOut; ///< that were narrower than triangles are
};

/** Lets triangles of a part of a sheet grow, where shared points stay as they are. Parts that are done apart fit
 * together again: no side between shared points is taken away or made.
 * \param part     as that of MedialVoxelRemesh()
 * \param isShared of each point, whether other parts have it, too; empty: no
 * \param size     of elements; sides get that of MedialVoxelElementSize::MakeCoarse()
 * \param progress called often with the share that is done; may throw to stop */
MedialVoxelCoarsenedPart
MedialVoxelCoarsenPart(MedialVoxelSheet                    part,
                       const std::vector<bool> &           isShared,
                       const MedialVoxelElementSize &      size,
                       const std::function<void(double)> & progress);

} // end namespace itk

#endif
