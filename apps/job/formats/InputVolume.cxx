// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "MaskInput.h"
#include "ObjectValues.h"
#include "RawImageIO.h"
#include "ValueReader.h"
#include "VolumeFormats.h"

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelProgress.h"

#include <mutex>
#include <utility>
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
    , m_Header(header)
    , m_Options(options)
    , m_IsParallel(IsReadInParallel(header))
  {
    m_Readers.push_back(MakeValueReader(m_Header, GetInterpolation(m_Options)));
    m_FreeLanes.push_back({ m_Readers.front().get(), {} });
  }

  /** Resampling has threads of its own. */
  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_IsParallel ? itk::MedialVoxelSourceThreads::Several : itk::MedialVoxelSourceThreads::Calling;
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    std::uint64_t bytes = 0;
    for (const auto & reader : m_Readers)
    {
      bytes += reader->GetNumberOfBytesRead();
    }
    return bytes;
  }

protected:
  std::vector<itk::MedialVoxelBox>
  CutIntoParts(const itk::MedialVoxelBox & box) const override
  {
    const auto bytesPerSlice = static_cast<std::uint64_t>(box.Extent(0) * box.Extent(1)) * this->GetBytesPerVoxel();
    if (!m_IsParallel || bytesPerSlice <= BytesPerPart)
    {
      return InputVolume::CutIntoParts(box);
    }
    std::vector<itk::MedialVoxelBox> parts;
    for (itk::MedialVoxelBox slice = box; slice.lower[2] < box.upper[2]; ++slice.lower[2])
    {
      slice.upper[2] = slice.lower[2] + 1;
      const auto rows = InputVolume::CutIntoParts(slice);
      parts.insert(parts.end(), rows.begin(), rows.end());
    }
    return parts;
  }

  void
  FillPart(const itk::MedialVoxelBox & part, const VoxelTargets & targets) override
  {
    Lane lane = this->TakeLane();
    lane.values.resize(static_cast<std::size_t>(part.NumberOfVoxels()) * this->GetBytesPerVoxel());
    this->MeasureReading([&] { lane.reader->Read(part, lane.values.data()); });
    DispatchPixelType(m_Header.pixelType, [&](auto zero) {
      this->Pack(reinterpret_cast<const decltype(zero) *>(lane.values.data()), part, targets);
    });
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_FreeLanes.push_back(std::move(lane));
  }

private:
  /** What a thread needs to read. */
  struct Lane
  {
    ValueReader *          reader{ nullptr };
    std::vector<std::byte> values; // of a part
  };

  /** The lane that was used last goes on, so that one thread reads ahead in the file. */
  Lane
  TakeLane()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    if (m_FreeLanes.empty())
    {
      m_Readers.push_back(MakeValueReader(m_Header, GetInterpolation(m_Options)));
      return { m_Readers.back().get(), {} };
    }
    Lane lane = std::move(m_FreeLanes.back());
    m_FreeLanes.pop_back();
    return lane;
  }

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

  VolumeHeader                              m_Header;
  JobOptions                                m_Options;
  bool                                      m_IsParallel;
  std::mutex                                m_Mutex; // of what follows
  std::vector<std::unique_ptr<ValueReader>> m_Readers;
  std::vector<Lane>                         m_FreeLanes;
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
  const VolumeInput & input = header.format->input;
  return header.CanStream() && !header.stored && (input.isParallel || input.makeReader == MakeRawImageIO);
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
