// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMaskInput_h
#define medialvoxelMaskInput_h

#include "InputVolume.h"
#include "Resampling.h"

#include <filesystem>
#include <memory>

namespace medialvoxel
{

/** Opens a volume that does not stream; InputVolume::Prepare() will unpack it once from front to back into one bit per
 * voxel, which is set where the voxel is object. It has no values then. A rough object that is smoothed automatically
 * is unpacked a second time.
 * \param interpolation of a resampled volume
 * \param scratchFolder where the bits are kept; empty: in memory
 * \throw JobError Refused when there is no space in the scratch folder. */
std::unique_ptr<InputVolume>
OpenMaskInput(const VolumeHeader &          header,
              const JobOptions &            options,
              Interpolation                 interpolation,
              const std::filesystem::path & scratchFolder,
              Smoothing                     smoothing);

/** Bytes that smoothing takes beside the mask while the volume is unpacked. */
std::uint64_t
GetBytesOfSmoothedSlices(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
