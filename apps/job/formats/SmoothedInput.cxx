// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SmoothedInput.h"

#include "ObjectRoughness.h"
#include "SmoothingRule.h"
#include "VolumeText.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace medialvoxel
{
namespace
{

using Numbers = itk::MedialVoxelSmoothingNumbers;

/** Voxels that are read together with a margin of their own: few in memory, with little of them read twice. */
constexpr std::int64_t LeastRows = 32;
constexpr std::int64_t MostSlices = 64;

/** A multiple of the rows of chunks. */
std::int64_t
GetRowsOfStrip(const VolumeHeader & header)
{
  const auto & chunks = header.GetStored().chunks;
  const auto   rows = chunks && !header.stored ? static_cast<std::int64_t>(chunks->size[1]) : 1;
  return (LeastRows + rows - 1) / rows * rows;
}

itk::MedialVoxelBox
GetImage(const VolumeHeader & header)
{
  itk::MedialVoxelBox image{ {}, { { 1, 1, 1 } } };
  std::copy(header.geometry.size.begin(), header.geometry.size.end(), image.upper.begin());
  return image;
}

/** Calls function(part) for strips of rows in a few slices. */
template <typename TFunction>
void
ForEachStrip(const itk::MedialVoxelBox & box, std::int64_t rows, TFunction && function)
{
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; z += MostSlices)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1];)
    {
      itk::MedialVoxelBox part = box;
      part.lower[1] = y;
      part.lower[2] = z;
      part.upper[1] = std::min((y / rows + 1) * rows, box.upper[1]);
      part.upper[2] = std::min(z + MostSlices, box.upper[2]);
      function(part);
      y = part.upper[1];
    }
  }
}

} // namespace

SmoothedInput::SmoothedInput(const VolumeHeader & header,
                             const JobOptions &   options,
                             std::uint64_t        bytesToKeep,
                             Smoothing            smoothing)
  : StreamedInput(header, options, bytesToKeep)
  , m_Smoothing(smoothing)
{}

std::string
SmoothedInput::Prepare(const ReadObserver & observer)
{
  if (m_Smoothing != Smoothing::Automatic)
  {
    return {};
  }
  const auto & chunks = this->GetHeader().GetStored().chunks;
  m_Smoothing = Smoothing::Off;
  m_Roughness = MeasureRoughness(*this, GetImage(this->GetHeader()), chunks ? chunks->size[2] : 1, observer);
  m_Smoothing = m_Roughness->NeedsSmoothing() ? Smoothing::On : Smoothing::Off;
  return {};
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
    DispatchPixelType(this->GetHeader().pixelType, [&](auto zero) {
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
  const itk::MedialVoxelBox               image = GetImage(this->GetHeader());
  itk::MedialVoxelSmoother<TValue, TRule> smoother(image, rule);
  std::vector<TValue>                     values;
  ForEachStrip(box, GetRowsOfStrip(this->GetHeader()), [&](const itk::MedialVoxelBox & part) {
    itk::MedialVoxelPoll();
    const itk::MedialVoxelBox input = Numbers::GetInputBox(part, image);
    values.resize(static_cast<std::size_t>(input.NumberOfVoxels()));
    this->MeasureReading([&] { reader.Read(input, values.data()); });
    const itk::MedialVoxelStrides strides{ 1, input.Extent(0), input.Extent(0) * input.Extent(1) };
    smoother.Run(values.data(), strides, part, *targets.object);
    const ValueView view{ values.data() + input.OffsetOf(part.lower), strides, false };
    this->Pack<TValue>(view, part, { nullptr, targets.notANumber, targets.gray });
  });
}

std::uint64_t
SmoothedInput::GetBytesPerThread(const VolumeHeader & header)
{
  const itk::MedialVoxelBox image = GetImage(header);
  itk::MedialVoxelBox       strip = image;
  strip.upper[1] = std::min(image.upper[1], GetRowsOfStrip(header) + 2 * Numbers::Margin);
  strip.upper[2] = std::min(image.upper[2], MostSlices + 2 * Numbers::Margin);
  using LargestSmoother = itk::MedialVoxelSmoother<double, itk::MedialVoxelValueSmoothing<double>>;
  return static_cast<std::uint64_t>(strip.NumberOfVoxels()) * GetTraits(header.pixelType).bytes +
         LargestSmoother::GetBytes();
}

} // end namespace medialvoxel
