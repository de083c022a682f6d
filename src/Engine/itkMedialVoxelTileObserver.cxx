// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileObserver.h"

namespace itk
{

MedialVoxelTileObserver::~MedialVoxelTileObserver() = default;

MedialVoxelBits::WordType
MedialVoxelTileObserver::SelectCells(const MedialVoxelCellRow &) const
{
  return 0;
}

} // end namespace itk
