// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MaskInput.h"

#include "BitAppender.h"
#include "BitStore.h"
#include "ObjectRoughness.h"
#include "ObjectValues.h"
#include "SmoothedSlices.h"
#include "SmoothingRule.h"
#include "Text.h"
#include "ValueStream.h"

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cassert>
#include <type_traits>
#include <vector>

namespace medialvoxel
{
namespace
{

/** \class MaskInput
 * \brief One bit per voxel, made once. */
class MaskInput : public InputVolume
{
public:
  MaskInput(const VolumeHeader &          header,
            const JobOptions &            options,
            Interpolation                 interpolation,
            const std::filesystem::path & scratchFolder,
            Smoothing                     smoothing)
    : m_Header(header)
    , m_Options(options)
    , m_Interpolation(interpolation)
    , m_ScratchFolder(scratchFolder)
    , m_Smoothing(smoothing)
  {
    this->MakeBits();
  }

  std::string
  Prepare(const ReadObserver & observer) override
  {
    const bool isAutomatic = m_Smoothing == Smoothing::Automatic;
    const auto tellPart = [&observer](double begin, double end) {
      return [=, &observer](double fraction) { observer(begin + (end - begin) * fraction); };
    };
    constexpr double unpacked = 0.4;
    constexpr double measured = 0.6;
    this->Unpack(tellPart(0.0, isAutomatic ? unpacked : 1.0), m_Smoothing == Smoothing::On);
    if (isAutomatic)
    {
      m_Roughness = MeasureRoughness(*this, m_Header.geometry.GetVoxelBox(), 1, tellPart(unpacked, measured));
    }
    const bool isRough = m_Roughness && m_Roughness->NeedsSmoothing();
    if (isRough)
    {
      this->MakeBits();
      this->Unpack(tellPart(measured, 1.0), true);
    }
    const std::string times = isRough ? "twice, as its object is rough: " : "once: ";
    return m_Header.fileName.string() +
           (m_Header.compressed ? " is compressed and was unpacked " : " has scaled values and was read ") + times +
           FormatBytes(m_BytesRead) + " read, " + FormatBytes(GetBitStoreBytes(m_Header.geometry.GetNumberOfVoxels())) +
           " of mask " + (m_ScratchFolder.empty() ? "in memory" : "in " + m_ScratchFolder.string()) + ", " +
           FormatSeconds(this->GetReadSeconds());
  }

  std::optional<itk::MedialVoxelRoughness>
  GetRoughness() const override
  {
    return m_Roughness;
  }

  std::uint64_t
  GetNumberOfNotANumberVoxels() const override
  {
    return m_NotANumberVoxels;
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override
  {
    assert(targets.notANumber == nullptr && targets.gray == nullptr);
    for (const itk::MedialVoxelBox & part : itk::MedialVoxelEngineClient::CutForPull(box, 1))
    {
      itk::MedialVoxelPoll();
      this->FillPart(part, targets);
    }
  }

private:
  void
  FillPart(const itk::MedialVoxelBox & part, const VoxelTargets & targets)
  {
    for (std::int64_t z = part.lower[2]; z < part.upper[2]; ++z)
    {
      this->MeasureReading([&] { this->FillSlice(part, z, *targets.object); });
    }
  }

  /** The old ones go first, or there would be two of them. */
  void
  MakeBits()
  {
    const std::uint64_t voxels = m_Header.geometry.GetNumberOfVoxels();
    m_Bits.reset();
    m_Bits = m_ScratchFolder.empty() ? MakeBitStoreInMemory(voxels) : MakeBitStoreInFile(m_ScratchFolder, voxels);
  }

  void
  Unpack(const ReadObserver & observer, bool smooths)
  {
    m_NotANumberVoxels = 0;
    this->MeasureReading([&] {
      DispatchValueType(m_Header.GetStored(),
                        [&](auto zero) { this->UnpackValues<decltype(zero)>(observer, smooths); });
    });
  }

  template <typename TValue>
  void
  UnpackValues(const ReadObserver & observer, bool smooths)
  {
    if (m_Header.stored)
    {
      this->Pack<double>(smooths, [&](const auto & take) { this->Resample<TValue>(observer, take); });
      return;
    }
    this->Pack<TValue>(smooths,
                       [&](const auto & take) { m_BytesRead += StreamValues<TValue>(m_Header, observer, take); });
  }

  /** Calls stream(take), which calls take(values) for all values from front to back, and keeps the object. */
  template <typename TValue, typename TStream>
  void
  Pack(bool smooths, TStream && stream)
  {
    BitAppender bits(*m_Bits);
    if (smooths)
    {
      WithSmoothingRule<TValue>(m_Options, [&](const auto & rule) {
        using RuleType = std::decay_t<decltype(rule)>;
        SmoothedSlices<TValue, RuleType> slices(
          m_Header.geometry.GetVoxelBox(), rule, [&](const itk::MedialVoxelBits & object) { bits.Append(object); });
        stream([&](const std::vector<TValue> & values) {
          this->CountNotANumber(values);
          slices.Append(values);
        });
      });
    }
    else
    {
      const auto predicate = MakeObjectPredicate<TValue>(m_Options);
      stream([&](const std::vector<TValue> & values) {
        this->CountNotANumber(values);
        bits.Append(values, predicate);
      });
    }
    bits.Finish();
  }

  template <typename TValue, typename TTake>
  void
  Resample(const ReadObserver & observer, const TTake & take)
  {
    std::vector<double> values;
    SliceResampler      resampler(m_Header, m_Interpolation, [&](const double * row, std::uint64_t count) {
      values.insert(values.end(), row, row + count);
      if (values.size() >= VoxelsPerChunk)
      {
        take(values);
        values.clear();
      }
    });
    m_BytesRead += StreamValues<TValue>(
      m_Header.GetStored(), observer, [&](const std::vector<TValue> & stored) { resampler.Append(stored); });
    take(values);
  }

  template <typename TValue>
  void
  CountNotANumber(const std::vector<TValue> & values)
  {
    if constexpr (std::is_floating_point<TValue>::value)
    {
      m_NotANumberVoxels += static_cast<std::uint64_t>(
        std::count_if(values.begin(), values.end(), [](TValue value) { return value != value; }));
    }
  }

  /** Reads all words from the first to the last row of a slice at once. */
  void
  FillSlice(const itk::MedialVoxelBox & part, std::int64_t z, itk::MedialVoxelBits & object)
  {
    const std::uint64_t firstWord = this->GetVoxel(part.lower[0], part.lower[1], z) / BitStore::BitsPerWord;
    const std::uint64_t lastWord = this->GetVoxel(part.upper[0] - 1, part.upper[1] - 1, z) / BitStore::BitsPerWord;
    m_Words.resize(lastWord - firstWord + 1);
    m_Bits->Read(firstWord, m_Words.size(), m_Words.data());
    for (std::int64_t y = part.lower[1]; y < part.upper[1]; ++y)
    {
      const std::uint64_t first = this->GetVoxel(part.lower[0], y, z) - firstWord * BitStore::BitsPerWord;
      auto * const        row = object.GetRow(y, z) - object.GetFirstWord();
      CopyBits(m_Words.data(), first, part.lower[0], part.Extent(0), row);
    }
  }

  /** Number of a voxel in the whole volume. */
  std::uint64_t
  GetVoxel(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    const auto & size = m_Header.geometry.size;
    return (static_cast<std::uint64_t>(z) * size[1] + static_cast<std::uint64_t>(y)) * size[0] +
           static_cast<std::uint64_t>(x);
  }

  VolumeHeader                             m_Header;
  JobOptions                               m_Options;
  Interpolation                            m_Interpolation;
  std::filesystem::path                    m_ScratchFolder;
  Smoothing                                m_Smoothing;
  std::optional<itk::MedialVoxelRoughness> m_Roughness;
  std::unique_ptr<BitStore>                m_Bits;
  std::vector<BitStore::WordType>          m_Words; ///< of a slice of a part
  std::uint64_t                            m_NotANumberVoxels{ 0 };
  std::uint64_t                            m_BytesRead{ 0 };
};

} // namespace

std::unique_ptr<InputVolume>
OpenMaskInput(const VolumeHeader &          header,
              const JobOptions &            options,
              Interpolation                 interpolation,
              const std::filesystem::path & scratchFolder,
              Smoothing                     smoothing)
{
  return std::make_unique<MaskInput>(header, options, interpolation, scratchFolder, smoothing);
}

std::uint64_t
GetBytesOfSmoothedSlices(const VolumeHeader & header)
{
  using LargestSmoother = itk::MedialVoxelSmoother<double, itk::MedialVoxelValueSmoothing<double>>;
  const VolumeHeader & stored = header.GetStored();
  const bool           isDouble = header.stored || stored.scale;
  const auto &         size = header.geometry.size;
  const std::uint64_t  slices =
    size.size() > 2 ? std::min<std::uint64_t>(SmoothedSlicesNumbers::MostSlices, size[2]) : 1;
  const std::uint64_t bytes = isDouble ? sizeof(double) : GetTraits(stored.pixelType).bytes;
  return (slices * size[0] * size[1] + VoxelsPerChunk) * bytes + LargestSmoother::GetBytes();
}

} // end namespace medialvoxel
