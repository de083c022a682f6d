// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ScanMeasure.h"

#include "Errors.h"
#include "PartRunner.h"

#include <cmath>

namespace medialvoxel
{
namespace
{

/** With these the survey stays below the smallest limit of memory. */
constexpr unsigned int MostThreads = 3;

} // namespace

WallMeasure
FindWallMeasure(InputVolume &          input,
                const VolumeHeader &   header,
                const ExtractOptions & options,
                const ReadObserver &   observer)
{
  if (!MayMeasureOnGrayValues(options, header))
  {
    return { false, std::nullopt, DescribeMeasureOnObject(options, header) };
  }
  const auto  range = GetGrayRange(options, header);
  WallMeasure measure{ true, std::nullopt, {} };
  if (std::isfinite(range.lower) && std::isfinite(range.upper))
  {
    measure.reason = "between two thresholds";
    return measure;
  }
  const bool isParallel = input.GetSourceThreads() == itk::MedialVoxelSourceThreads::Several;
  PartRunner runner;
  runner.LimitThreads(MostThreads);
  itk::MedialVoxelScanSurvey::Source source;
  source.fill = [&input](const auto & box, auto & object, auto & gray) {
    input.Fill(box, { &object, nullptr, &gray });
  };
  source.forEach = [&](const auto & boxes, const auto & work) { runner.Run(boxes, isParallel, work); };
  source.observe = observer;
  const itk::MedialVoxelScanSurvey survey(
    GetGrid(options, header), std::isfinite(range.lower) ? range.lower : range.upper, options.levels);
  const auto result = survey.Run(source);
  if (!result.scan && !options.uncertaintyFile.empty())
  {
    Fail(ExitStatus::Refused,
         header.fileName.string(),
         ": the uncertainty of the thickness cannot be stated, as ",
         result.reason);
  }
  measure.scan = result.scan;
  measure.reason = result.reason;
  measure.usesGrayValues = !result.isMask;
  return measure;
}

std::optional<itk::MedialVoxelExtraction::GrayRange>
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
