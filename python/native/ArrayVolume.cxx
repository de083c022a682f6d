// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayVolume.h"

#include "SmoothingRule.h"
#include "ValuePacking.h"

#include "itkMedialVoxelProgress.h"

namespace medialvoxel
{

ArrayVolume::ArrayVolume(const ArrayCall & call, const JobOptions & options, const bool isSmoothed)
  : m_Call(call)
  , m_Options(options)
  , m_IsSmoothed(isSmoothed)
{}

itk::MedialVoxelSourceThreads
ArrayVolume::GetSourceThreads() const
{
  return itk::MedialVoxelSourceThreads::Several;
}

std::uint64_t
ArrayVolume::GetNumberOfBytesRead() const
{
  return 0;
}

void
ArrayVolume::Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets)
{
  DispatchPixelType(m_Call.header.pixelType, [&](auto zero) {
    using Value = decltype(zero);
    VoxelTargets others = targets;
    if (m_IsSmoothed && targets.object != nullptr)
    {
      this->FillSmoothed<Value>(box, *targets.object);
      others.object = nullptr;
    }
    PackValues<Value>(this->GetView<Value>(box), box, m_Options, others);
  });
}

/** Begins at the lowest voxel of a box. */
template <typename TValue>
ValueView
ArrayVolume::GetView(const itk::MedialVoxelBox & box) const
{
  const std::int64_t * const    size = m_Call.array.size;
  const itk::MedialVoxelStrides strides{ { 1, size[0], size[0] * size[1] } };
  const std::int64_t            offset = box.lower[0] + strides[1] * box.lower[1] + strides[2] * box.lower[2];
  return { static_cast<const TValue *>(m_Call.array.values) + offset, strides, false };
}

template <typename TValue>
void
ArrayVolume::FillSmoothed(const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object) const
{
  using Numbers = itk::MedialVoxelSmoothingNumbers;
  const itk::MedialVoxelBox image = m_Call.header.geometry.GetVoxelBox();
  WithSmoothingRule<TValue>(m_Options, [&](const auto & rule) {
    itk::MedialVoxelSmoother<TValue, std::decay_t<decltype(rule)>> smoother(image, rule);
    itk::MedialVoxelForEachStrip(box, Numbers::RowsOfStrip, [&](const itk::MedialVoxelBox & part) {
      itk::MedialVoxelPoll();
      const ValueView view = this->GetView<TValue>(Numbers::GetInputBox(part, image));
      smoother.Run(static_cast<const TValue *>(view.values), view.strides, part, object);
    });
  });
}

} // end namespace medialvoxel
