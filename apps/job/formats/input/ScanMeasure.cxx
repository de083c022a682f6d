// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ScanMeasure.h"

#include "Errors.h"

#include <algorithm>

namespace medialvoxel
{

WallMeasure
FindWallMeasure(InputVolume &          input,
                const VolumeHeader &   header,
                const ExtractOptions & options,
                const unsigned int     threads,
                const ReadObserver &   observer)
{
  if (!MayMeasureOnGrayValues(options, header))
  {
    return { false, std::nullopt, DescribeMeasureOnObject(options, header) };
  }
  const auto range = GetGrayRange(options, header);
  auto &     object = dynamic_cast<itk::MedialVoxelObjectInput &>(input.GetInput());
  const auto mostThreads = std::max(itk::MedialVoxelObjectInput::LeastSurveyThreads, threads);
  const auto result =
    object.SurveyScan(GetGrid(header), range.lower, range.upper, options.materials, observer, mostThreads);
  if (!result.scan && !options.uncertaintyFile.empty())
  {
    Fail(ExitStatus::Refused,
         header.fileName.string(),
         ": the uncertainty of the thickness cannot be stated, as ",
         result.reason);
  }
  return { !result.isMask, result.scan, result.reason };
}

std::optional<itk::MedialVoxelSheetExtraction::GrayRange>
GetGrayRange(const WallMeasure & measure, const JobOptions & options, const VolumeHeader & header)
{
  if (!measure.usesGrayValues)
  {
    return std::nullopt;
  }
  auto range = GetGrayRange(options, header);
  range.scan = measure.scan;
  return range;
}

} // end namespace medialvoxel
