// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "WallMeasure.h"

#include "Text.h"

namespace medialvoxel
{

std::string
Describe(const WallMeasure & measure)
{
  const std::string because = measure.reason.empty() ? "" : ": " + measure.reason;
  if (!measure.usesGrayValues)
  {
    return "on the object" + because;
  }
  if (!measure.scan)
  {
    return "where gray values cross the threshold" + because;
  }
  const itk::MedialVoxelScan & scan = *measure.scan;
  return "by fits to gray values: background " + FormatShort(scan.background) + ", material " +
         FormatShort(scan.material) + ", blur " + FormatShort(scan.blur) + " voxels, noise " +
         FormatFixed(100.0 * scan.GetRelativeNoise(), 1) + " % of the contrast";
}

} // end namespace medialvoxel
