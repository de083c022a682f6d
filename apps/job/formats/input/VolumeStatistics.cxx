// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeStatistics.h"

#include "PipelineErrors.h"
#include "SliceSeries.h"
#include "VolumeSource.h"

namespace medialvoxel
{
namespace
{

Paddings
ListPaddings(const VolumeHeader & header)
{
  Paddings paddings;
  for (const SliceHeader & slice : header.series ? header.series->slices : std::vector<SliceHeader>{})
  {
    if (slice.padding)
    {
      paddings.insert(*slice.padding);
    }
  }
  return paddings;
}

} // namespace

ValueStatistics
MeasureValues(const VolumeHeader & header, const ReadObserver & observer)
{
  return WithPipelineErrors([&] {
    // Resampling is for the object; the statistics are of the stored values.
    const VolumeHeader & stored = header.GetStored();
    VolumeSource         source(stored, Interpolation::Nearest, 0);
    return MeasureValues(source, stored.geometry.GetVoxelBox(), ListPaddings(stored), observer);
  });
}

void
MeasureThreshold(JobOptions & options, const VolumeHeader & header, const ProgressSink & sink)
{
  if (!options.lowerIsOtsu || options.lowerThreshold)
  {
    return;
  }
  SetOtsuThreshold(options, header, MeasureValues(header, [&sink](double) { ThrowIfStopRequested(sink); }));
}

} // end namespace medialvoxel
