// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelResampledInput_h
#define medialvoxelResampledInput_h

#include "InputVolume.h"
#include "Resampling.h"

#include <memory>

namespace medialvoxel
{

/** Opens an uncompressed volume of ResampleHeader(): an image of doubles, the parts of which are made as they are asked
 * for. */
std::unique_ptr<InputVolume>
OpenResampledInput(const VolumeHeader & header, Interpolation interpolation);

} // end namespace medialvoxel

#endif
