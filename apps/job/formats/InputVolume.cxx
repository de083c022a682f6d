// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "MaskInput.h"
#include "ObjectValues.h"
#include "ReaderPool.h"
#include "VolumeFormats.h"

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelProgress.h"

#include <chrono>
#include <vector>

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
  StreamedInput(const VolumeHeader & header, const JobOptions & options)
    : InputVolume(GetTraits(header.pixelType).bytes)
    , m_PixelType(header.pixelType)
    , m_Options(options)
    , m_Readers(header, GetInterpolation(options))
  {}

  /** Resampling has threads of its own. */
  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_Readers.IsParallel() ? itk::MedialVoxelSourceThreads::Several : itk::MedialVoxelSourceThreads::Calling;
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Readers.GetNumberOfBytesRead();
  }

protected:
  std::vector<itk::MedialVoxelBox>
  CutIntoParts(const itk::MedialVoxelBox & box) const override
  {
    return m_Readers.CutIntoParts(box);
  }

  void
  FillPart(const itk::MedialVoxelBox & part, const VoxelTargets & targets) override
  {
    const auto start = std::chrono::steady_clock::now();
    m_Readers.Read(part, [&](const std::byte * values) {
      this->AddReadSeconds(start);
      DispatchPixelType(
        m_PixelType, [&](auto zero) { this->Pack(reinterpret_cast<const decltype(zero) *>(values), part, targets); });
    });
  }

private:
  template <typename TValue>
  void
  Pack(const TValue * values, const itk::MedialVoxelBox & part, const VoxelTargets & targets) const
  {
    const itk::MedialVoxelStrides strides{ 1, part.Extent(0), part.Extent(0) * part.Extent(1) };
    if (targets.object != nullptr)
    {
      itk::MedialVoxelPackBox(values, strides, part, MakeObjectPredicate<TValue>(m_Options), *targets.object);
    }
    if (targets.notANumber != nullptr)
    {
      itk::MedialVoxelPackBox(values, strides, part, [](TValue value) { return value != value; }, *targets.notANumber);
    }
    if (targets.gray != nullptr)
    {
      itk::MedialVoxelCopyBox(values, strides, part, *targets.gray);
    }
  }

  PixelType  m_PixelType;
  JobOptions m_Options;
  ReaderPool m_Readers;
};

} // namespace

std::vector<itk::MedialVoxelBox>
InputVolume::CutIntoParts(const itk::MedialVoxelBox & box) const
{
  return itk::MedialVoxelEngineClient::CutForPull(box, m_BytesPerVoxel);
}

bool
InputVolume::IsReadInParallel(const VolumeHeader & header)
{
  return header.CanStream() && !header.stored && header.liesInRows;
}

void
InputVolume::Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets)
{
  for (const itk::MedialVoxelBox & part : this->CutIntoParts(box))
  {
    itk::MedialVoxelPoll();
    this->FillPart(part, targets);
  }
}

std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header, const JobOptions & options, const std::filesystem::path & scratchFolder)
{
  if (header.CanStream())
  {
    return std::make_unique<StreamedInput>(header, options);
  }
  return OpenMaskInput(header, options, GetInterpolation(options), scratchFolder);
}

} // end namespace medialvoxel
