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

} // end namespace medialvoxel

#endif
