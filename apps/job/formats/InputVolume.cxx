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
  StreamedInput(const VolumeHeader & header, const JobOptions & options, std::uint64_t bytesToKeep)
    : m_Header(header)
    , m_Options(options)
    , m_IsParallel(IsReadInParallel(header))
  {
    m_Readers.push_back(MakeValueReader(m_Header, GetInterpolation(m_Options), bytesToKeep));
    m_FreeReaders.push_back(m_Readers.front().get());
  }

  /** Resampling has threads of its own. */
  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override
  {
    return m_IsParallel ? itk::MedialVoxelSourceThreads::Several : itk::MedialVoxelSourceThreads::Calling;
  }

  std::int64_t
  GetRowsReadTogether() const override
  {
    return m_Readers.front()->GetRowsReadTogether();
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

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override
  {
    ValueReader * const reader = this->TakeReader();
    DispatchPixelType(m_Header.pixelType, [&](auto zero) {
      reader->ForEachPart(box, [&](const itk::MedialVoxelBox & part) {
        itk::MedialVoxelPoll();
        ValueView view;
        this->MeasureReading([&] { view = reader->Look(part); });
        this->Pack<decltype(zero)>(view, part, targets);
      });
    });
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_FreeReaders.push_back(reader);
  }

private:
  /** The one that was used last goes on, so that one thread reads ahead in the file. */
  ValueReader *
  TakeReader()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    if (m_FreeReaders.empty())
    {
      m_Readers.push_back(m_Readers.front()->MakeAnother());
      return m_Readers.back().get();
    }
    ValueReader * const reader = m_FreeReaders.back();
    m_FreeReaders.pop_back();
    return reader;
  }

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

  VolumeHeader                              m_Header;
  JobOptions                                m_Options;
  bool                                      m_IsParallel;
  std::mutex                                m_Mutex; // of what follows
  std::vector<std::unique_ptr<ValueReader>> m_Readers;
  std::vector<ValueReader *>                m_FreeReaders;
};

} // namespace

bool
InputVolume::IsReadInParallel(const VolumeHeader & header)
{
  return header.CanStream() && !header.stored && (header.chunks || header.format->input.makeReader == MakeRawImageIO);
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
