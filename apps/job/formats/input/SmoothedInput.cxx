// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SmoothedInput.h"

#include "ObjectRoughness.h"
#include "SmoothingRule.h"
#include "ValuePacking.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace medialvoxel
{
namespace
{

using Numbers = itk::MedialVoxelSmoothingNumbers;

/** A multiple of the rows of chunks. */
std::int64_t
GetRowsOfStrip(const VolumeHeader & header)
{
  const auto & chunks = header.GetStored().chunks;
  const auto   rows = chunks && !header.stored ? static_cast<std::int64_t>(chunks->size[1]) : 1;
  return (Numbers::RowsOfStrip + rows - 1) / rows * rows;
}

} // namespace

SmoothedInput::SmoothedInput(const VolumeHeader & header,
                             const JobOptions &   options,
                             std::uint64_t        bytesToKeep,
                             Smoothing            smoothing)
  : StreamedInput(header, options, bytesToKeep)
  , m_Smoothing(smoothing)
{}

void
SmoothedInput::Prepare(const ReadObserver & observer)
{
  if (m_Smoothing != Smoothing::Automatic)
  {
    return;
  }
  const auto & chunks = this->GetHeader().GetStored().chunks;
  m_Smoothing = Smoothing::Off;
  m_Roughness =
    MeasureRoughness(*this, this->GetHeader().geometry.GetVoxelBox(), chunks ? chunks->size[2] : 1, observer);
  m_Smoothing = m_Roughness->NeedsSmoothing() ? Smoothing::On : Smoothing::Off;
}

std::int64_t
SmoothedInput::GetRowsReadTogether() const
{
  return m_Smoothing == Smoothing::On ? GetRowsOfStrip(this->GetHeader()) : StreamedInput::GetRowsReadTogether();
}

void
SmoothedInput::Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets)
{
  assert(m_Smoothing != Smoothing::Automatic);
  if (m_Smoothing == Smoothing::Off || targets.object == nullptr)
  {
    StreamedInput::Fill(box, targets);
    return;
  }
  this->GetReaders().With([&](ValueReader & reader) {
    DispatchPixelType(this->GetHeader().GetValueType(), [&](auto zero) {
      using ValueType = decltype(zero);
      WithSmoothingRule<ValueType>(
        this->GetOptions(), [&](const auto & rule) { this->FillSmoothed<ValueType>(reader, rule, box, targets); });
    });
  });
}

template <typename TValue, typename TRule>
void
SmoothedInput::FillSmoothed(ValueReader &               reader,
                            const TRule &               rule,
                            const itk::MedialVoxelBox & box,
                            const VoxelTargets &        targets)
{
  const itk::MedialVoxelBox               image = this->GetHeader().geometry.GetVoxelBox();
  itk::MedialVoxelSmoother<TValue, TRule> smoother(image, rule);
  std::vector<TValue>                     values;
  itk::MedialVoxelForEachStrip(box, GetRowsOfStrip(this->GetHeader()), [&](const itk::MedialVoxelBox & part) {
    itk::MedialVoxelPoll();
    const itk::MedialVoxelBox input = Numbers::GetInputBox(part, image);
    values.resize(static_cast<std::size_t>(input.NumberOfVoxels()));
    this->MeasureReading([&] { reader.Read(input, values.data()); });
    const itk::MedialVoxelStrides strides{ 1, input.Extent(0), input.Extent(0) * input.Extent(1) };
    smoother.Run(values.data(), strides, part, *targets.object);
    const ValueView view{ values.data() + input.OffsetOf(part.lower), strides, false };
    PackValues<TValue>(view, part, this->GetOptions(), { nullptr, targets.notANumber, targets.gray });
  });
}

std::uint64_t
SmoothedInput::GetBytesPerThread(const VolumeHeader & header)
{
  const itk::MedialVoxelBox image = header.geometry.GetVoxelBox();
  itk::MedialVoxelBox       strip = image;
  strip.upper[1] = std::min(image.upper[1], GetRowsOfStrip(header) + 2 * Numbers::Margin);
  strip.upper[2] = std::min(image.upper[2], Numbers::SlicesOfStrip + 2 * Numbers::Margin);
  using LargestSmoother = itk::MedialVoxelSmoother<double, itk::MedialVoxelValueSmoothing<double>>;
  return static_cast<std::uint64_t>(strip.NumberOfVoxels()) * GetTraits(header.GetValueType()).bytes +
         LargestSmoother::GetBytes();
}

} // end namespace medialvoxel
