// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelValueSource.h"

#include "itkMedialVoxelSlabPlan.h"

#include <algorithm>

namespace itk
{

MedialVoxelValueSource::~MedialVoxelValueSource() = default;

MedialVoxelSourceThreads
MedialVoxelValueSource::GetSourceThreads() const
{
  return MedialVoxelSourceThreads::Calling;
}

std::int64_t
MedialVoxelValueSource::GetRowsReadTogether() const
{
  return 1;
}

std::int64_t
MedialVoxelValueSource::GetSlicesReadTogether() const
{
  return 1;
}

void
MedialVoxelValueSource::ForEachSpan(const MedialVoxelBox & box, const SpanFunction & function)
{
  const std::size_t bytesPerVoxel =
    MedialVoxelWithValueType(this->GetValueType(), [](const auto zero) { return sizeof(zero); });
  for (const MedialVoxelBox & span : this->CutIntoSpans(box, bytesPerVoxel))
  {
    this->WithBox(span, [&](const MedialVoxelValueView & view) { function(span, view); });
  }
}

auto
MedialVoxelValueSource::CutIntoSpans(const MedialVoxelBox & box, const std::size_t bytesPerVoxel) const -> Boxes
{
  return CutForPull(box, bytesPerVoxel);
}

void
MedialVoxelValueSource::ForEach(const Boxes & boxes, unsigned int, const Work & work)
{
  std::for_each(boxes.begin(), boxes.end(), work);
}

auto
MedialVoxelValueSource::CutForPull(const MedialVoxelBox & box, const std::size_t bytesPerVoxel) -> Boxes
{
  constexpr std::int64_t bytesPerPull = 1 << 20;
  const std::int64_t     bytesPerRow = box.Extent(0) * static_cast<std::int64_t>(bytesPerVoxel);
  MedialVoxelIndex       size{ { box.upper[0], box.upper[1], box.upper[2] } };
  if (box.Extent(2) > 1)
  {
    size[2] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow * box.Extent(1)));
  }
  else if (box.Extent(1) > 1)
  {
    size[1] = std::max<std::int64_t>(1, bytesPerPull / std::max<std::int64_t>(1, bytesPerRow));
  }
  return MedialVoxelCutIntoTiles(box, size);
}

} // end namespace itk
