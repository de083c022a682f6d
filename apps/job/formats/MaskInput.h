// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMaskInput_h
#define medialvoxelMaskInput_h

#include "InputVolume.h"
#include "Options.h"
#include "Resampling.h"

#include "itkMedialVoxelLimit.h"

#include <filesystem>

namespace medialvoxel
{

/** Which voxels are object, and where their bits are kept. */
struct UnpackSettings
{
  std::optional<itk::MedialVoxelLimit> lowerThreshold; ///< neither set: all values but 0 are object
  std::optional<itk::MedialVoxelLimit> upperThreshold;
  std::optional<LabelValue>            label;                                  ///< set: this value alone is object
  std::filesystem::path                scratchFolder;                          ///< empty: bits are kept in memory
  Interpolation                        interpolation{ Interpolation::Linear }; ///< of a header with stored
};

/** Opens a volume that does not stream; InputVolume::Prepare() will unpack it once from front to back into one bit per
 * voxel, which is set where the voxel is object. Its image has the values 0 and 1.
 * \throw JobError Refused when there is no space in the scratch folder. */
std::unique_ptr<InputVolume>
OpenMaskInput(const VolumeHeader & header, const UnpackSettings & settings);

} // end namespace medialvoxel

#endif
