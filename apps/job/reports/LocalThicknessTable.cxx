// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LocalThicknessTable.h"

#include <string>

namespace medialvoxel
{

float
GetLargestBall(const ExtractOptions & options, const VolumeHeader & input)
{
  return static_cast<float>(GetLocalThickness(options, GetGrid(options, input)).maximumThickness);
}

TextTable
DescribeLocalThickness(const ExtractOptions & options, const JobResult & result)
{
  const itk::MedialVoxelLocalThicknessSums & sums = result.sums.localThickness;
  if (options.localThicknessFile.empty() || sums.voxels == 0)
  {
    return {};
  }
  const float maximum = GetLargestBall(options, result.input);
  return { { "local thickness",
             "mean " + FormatShort(sums.GetMean(maximum)) + ", standard deviation " +
               FormatShort(sums.GetStandardDeviation(maximum)) + ", largest " +
               FormatShort(static_cast<double>(sums.largest)) + ", in " + DescribeUnit(options, result.input.geometry) +
               ", of " + std::to_string(sums.voxels) + " object voxels" } };
}

} // end namespace medialvoxel
