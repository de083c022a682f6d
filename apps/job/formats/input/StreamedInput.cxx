// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "StreamedInput.h"

#include "ValuePacking.h"

#include "itkMedialVoxelProgress.h"

namespace medialvoxel
{

Interpolation
GetInterpolation(const JobOptions & options)
{
  const bool hasThreshold = options.lowerThreshold || options.upperThreshold;
  return hasThreshold && options.lowerThreshold != options.upperThreshold ? Interpolation::Linear
                                                                          : Interpolation::Nearest;
}

StreamedInput::StreamedInput(const VolumeHeader & header, const JobOptions & options, std::uint64_t bytesToKeep)
  : m_Header(header)
  , m_Options(options)
  , m_Readers(header, GetInterpolation(options), bytesToKeep)
{}

itk::MedialVoxelSourceThreads
StreamedInput::GetSourceThreads() const
{
  return IsReadInParallel(m_Header) ? itk::MedialVoxelSourceThreads::Several : itk::MedialVoxelSourceThreads::Calling;
}

void
StreamedInput::Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets)
{
  m_Readers.With([&](ValueReader & reader) {
    DispatchPixelType(m_Header.GetValueType(), [&](auto zero) {
      reader.ForEachPart(box, [&](const itk::MedialVoxelBox & part) {
        itk::MedialVoxelPoll();
        ValueView view;
        this->MeasureReading([&] { view = reader.Look(part); });
        PackValues<decltype(zero)>(view, part, m_Options, targets);
      });
    });
  });
}

} // end namespace medialvoxel
