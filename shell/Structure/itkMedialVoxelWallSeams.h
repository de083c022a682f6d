// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallSeams_h
#define itkMedialVoxelWallSeams_h

#include "itkMedialVoxelSheetWalls.h"
#include "itkMedialVoxelWallPieces.h"

namespace itk
{

/** The seams of walls: one for each set of walls that meet along a line. Where lines end, as in the corner of a box,
 * more walls meet in a point, which makes no seam.
 * \param numberOf the number of each wall of \a pieces */
std::vector<MedialVoxelSeamRow>
MedialVoxelFindSeams(const MedialVoxelSheetGraph &                     graph,
                     const MedialVoxelWallPieces &                     pieces,
                     const std::vector<MedialVoxelSheetGraph::Index> & numberOf);

} // end namespace itk

#endif
