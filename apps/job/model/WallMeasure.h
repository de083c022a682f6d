// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWallMeasure_h
#define medialvoxelWallMeasure_h

#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelScanSurvey.h"

#include <optional>
#include <string>

namespace medialvoxel
{

/** How the walls of a volume are measured. */
struct WallMeasure
{
  bool                                usesGrayValues{ false }; ///< otherwise on the object
  std::optional<itk::MedialVoxelScan> scan;   ///< that walls are fitted with; none: gray values cross the threshold
  std::string                         reason; ///< why there is no scan
};

/** What the uncertainty of a thickness is made of, and what not. */
constexpr const char * UncertaintyCovers =
  "noise of the values with its correlation, the place between the voxels (0.03 voxels), levels (1 % of the thickness)";
constexpr const char * UncertaintyLeavesOut =
  "wrong levels beside unseen walls, beam hardening and other artifacts, curved walls, the scale of the scan";

/** The same for a reader, in a line. */
std::string
Describe(const WallMeasure & measure);

} // end namespace medialvoxel

#endif
