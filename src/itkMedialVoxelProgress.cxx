// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelProgress.h"

namespace itk
{

MedialVoxelProgress::~MedialVoxelProgress() = default;

} // end namespace itk
