// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileObserver.h"

namespace itk
{

MedialVoxelTileObserver::~MedialVoxelTileObserver() = default;

} // end namespace itk
