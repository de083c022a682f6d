// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelScanBlocks_h
#define itkMedialVoxelScanBlocks_h

#include "itkMedialVoxelGrid.h"

#include <vector>

namespace itk
{

/** \brief The block that a voxel is in, of those that a MedialVoxelScanSurvey cuts an image into.
 * \ingroup MedialVoxel */
MedialVoxelBox
MedialVoxelGetScanBlock(const MedialVoxelIndex & voxel);

/** \brief More parts than threads, so that none waits long for the last one of another.
 * \ingroup MedialVoxel */
std::vector<MedialVoxelBox>
MedialVoxelCutScanBlocks(const std::vector<MedialVoxelBox> & blocks);

/** \brief All blocks of a small image, otherwise some, in the order of their hashes.
 * \ingroup MedialVoxel */
std::vector<MedialVoxelBox>
MedialVoxelChooseScanBlocks(const MedialVoxelBox & image);

} // end namespace itk

#endif
