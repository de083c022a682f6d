// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "MaskInput.h"
#include "ObjectValues.h"
#include "ReaderPool.h"
#include "VolumeFormats.h"

#include "itkMedialVoxelProgress.h"

namespace medialvoxel
{
namespace
{

/** Between labels there are no values: not without a threshold, and not with one value for both. A label has no
 * thresholds. */
Interpolation
GetInterpolation(const JobOptions & options)
{
  const bool hasThreshold = options.lowerThreshold || options.upperThreshold;
  return hasThreshold && options.lowerThreshold != options.upperThreshold ? Interpolation::Linear
                                                                          : Interpolation::Nearest;
}

/** \class StreamedInput
 * \brief Reads the boxes that it is asked for, each thread with a reader of its own. */
class StreamedInput : public InputVolume
{
public:
  StreamedInput(const VolumeHeader & header, const JobOptions & options, std::uint64_t bytesToKeep)
    : m_PixelType(header.pixelType)
    , m_Options(options)
    , m_IsParallel(IsReadInParallel(header))
    , m_Readers(header, GetInterpolation(options), bytesToKeep)
  {}

  /** Resampling has threads of its own. */
  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_IsParallel ? itk::MedialVoxelSourceThreads::Several : itk::MedialVoxelSourceThreads::Calling;
  }

  std::int64_t
  GetRowsReadTogether() const override
  {
    return m_Readers.GetRowsReadTogether();
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Readers.GetNumberOfBytesRead();
  }

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override
  {
    m_Readers.With([&](ValueReader & reader) {
      DispatchPixelType(m_PixelType, [&](auto zero) {
        reader.ForEachPart(box, [&](const itk::MedialVoxelBox & part) {
          itk::MedialVoxelPoll();
          ValueView view;
          this->MeasureReading([&] { view = reader.Look(part); });
          this->Pack<decltype(zero)>(view, part, targets);
        });
      });
    });
  }

private:
  template <typename TValue>
  void
  Pack(const ValueView & view, const itk::MedialVoxelBox & part, const VoxelTargets & targets) const
  {
    const auto * const values = static_cast<const TValue *>(view.values);
    const auto         pack = [&](const auto & predicate, itk::MedialVoxelBits * bits) {
      // Bits that stay clear need no look at each voxel.
      if (bits != nullptr && !(view.areEqual && !predicate(*values)))
      {
        itk::MedialVoxelPackBox(values, view.strides, part, predicate, *bits);
      }
    };
    pack(MakeObjectPredicate<TValue>(m_Options), targets.object);
    pack([](TValue value) { return value != value; }, targets.notANumber);
    if (targets.gray != nullptr)
    {
      itk::MedialVoxelCopyBox(values, view.strides, part, *targets.gray);
    }
  }

  PixelType  m_PixelType;
  JobOptions m_Options;
  bool       m_IsParallel;
  ReaderPool m_Readers;
};

} // namespace

bool
InputVolume::IsReadInParallel(const VolumeHeader & header)
{
  return header.CanStream() && !header.stored && (header.chunks || header.liesInRows);
}

std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader &          header,
                const JobOptions &            options,
                const std::filesystem::path & scratchFolder,
                std::uint64_t                 bytesToKeep)
{
  if (header.CanStream())
  {
    return std::make_unique<StreamedInput>(header, options, bytesToKeep);
  }
  return OpenMaskInput(header, options, GetInterpolation(options), scratchFolder);
}

} // end namespace medialvoxel
