// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeStatistics.h"

#include "PipelineErrors.h"
#include "SliceSeries.h"
#include "VolumeSource.h"

#include <algorithm>
#include <cstdint>

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

/** Resampling is for the object; the statistics are of the stored values. */
ValueStatistics
MeasureBox(const VolumeHeader & stored, const itk::MedialVoxelBox & box, const ReadObserver & observer)
{
  return WithPipelineErrors([&] {
    VolumeSource source(stored, Interpolation::Nearest, 0);
    return MeasureValues(source, box, ListPaddings(stored), observer);
  });
}

} // namespace

ValueStatistics
MeasureValues(const VolumeHeader & header, const ReadObserver & observer)
{
  return MeasureBox(header.GetStored(), header.GetStored().geometry.GetVoxelBox(), observer);
}

ValueStatistics
MeasureSomeValues(const VolumeHeader & header)
{
  constexpr std::int64_t most = std::int64_t{ 1 } << 22;
  itk::MedialVoxelBox    box = header.GetStored().geometry.GetVoxelBox();
  for (const unsigned int axis : { 2u, 1u })
  {
    const std::int64_t all = box.upper[axis];
    const std::int64_t some = std::clamp<std::int64_t>(most / (box.NumberOfVoxels() / all), 1, all);
    box.lower[axis] = (all - some) / 2;
    box.upper[axis] = box.lower[axis] + some;
  }
  return MeasureBox(header.GetStored(), box, [](double) {});
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
