// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MaskInput.h"

#include "BitImageSource.h"
#include "LabelValues.h"
#include "Text.h"
#include "ValueStream.h"

#include "itkMedialVoxelObjectPredicate.h"

#include <algorithm>
#include <array>
#include <limits>

namespace medialvoxel
{
namespace
{

using ByteOfPixels = std::array<unsigned char, 8>;

std::array<ByteOfPixels, 256>
MakeExpansionTable()
{
  std::array<ByteOfPixels, 256> table{};
  for (unsigned int byte = 0; byte < table.size(); ++byte)
  {
    for (unsigned int bit = 0; bit < 8; ++bit)
    {
      table[byte][bit] = (byte >> bit) & 1u;
    }
  }
  return table;
}

/** Writes the pixels [begin, begin + count) of the words. */
void
ExpandWords(const BitStore::WordType * words, std::uint64_t begin, std::uint64_t count, unsigned char * pixels)
{
  static const auto table = MakeExpansionTable();
  const auto        byteAt = [words](std::uint64_t bit) {
    return static_cast<unsigned char>(words[bit / BitStore::BitsPerWord] >> (bit % BitStore::BitsPerWord));
  };
  const std::uint64_t end = begin + count;
  for (; begin < end && begin % 8 != 0; ++begin)
  {
    *pixels++ = byteAt(begin) & 1u;
  }
  for (; begin + 8 <= end; begin += 8)
  {
    pixels = std::copy_n(table[byteAt(begin)].data(), 8, pixels);
  }
  for (; begin < end; ++begin)
  {
    *pixels++ = byteAt(begin) & 1u;
  }
}

template <typename TPixel>
itk::MedialVoxelObjectPredicate<TPixel>
MakePredicate(const UnpackSettings & settings)
{
  using PredicateType = itk::MedialVoxelObjectPredicate<TPixel>;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (settings.label)
  {
    return PredicateType::EqualTo(*ConvertLabel<TPixel>(*settings.label));
  }
  if (!settings.lowerThreshold && !settings.upperThreshold)
  {
    return PredicateType::DifferentFrom(TPixel{});
  }
  return PredicateType::InRange(settings.lowerThreshold.value_or(-infinity),
                                settings.upperThreshold.value_or(infinity));
}

template <unsigned int VDimension>
class MaskInput : public ImageInput<itk::Image<unsigned char, VDimension>>
{
public:
  MaskInput(const VolumeHeader & header, const UnpackSettings & settings)
    : m_Header(header)
    , m_Settings(settings)
    , m_Bits(settings.scratchFolder.empty()
               ? MakeBitStoreInMemory(header.geometry.GetNumberOfVoxels())
               : MakeBitStoreInFile(settings.scratchFolder, header.geometry.GetNumberOfVoxels()))
  {
    m_Source->SetGeometry(header.geometry);
    m_Source->SetBits(*m_Bits);
    this->MeasureSeconds(*m_Source);
  }

  std::string
  Prepare(const ReadObserver & observer) override
  {
    const auto start = std::chrono::steady_clock::now();
    DispatchValueType(m_Header.GetStored(), [&](auto zero) { this->Unpack<decltype(zero)>(observer); });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    this->m_ReadSeconds += seconds;
    return m_Header.fileName.string() +
           (m_Header.compressed ? " is compressed and was unpacked once: " : " has scaled values and was read once: ") +
           FormatBytes(m_BytesRead) + " read, " + FormatBytes(GetBitStoreBytes(m_Header.geometry.GetNumberOfVoxels())) +
           " of mask " + (m_Settings.scratchFolder.empty() ? "in memory" : "in " + m_Settings.scratchFolder.string()) +
           ", " + FormatSeconds(seconds);
  }

  bool
  IsMask() const override
  {
    return true;
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

  itk::ProcessObject *
  GetReader() override
  {
    return m_Source;
  }

  itk::Image<unsigned char, VDimension> *
  GetImage() override
  {
    return m_Source->GetOutput();
  }

private:
  template <typename TValue>
  void
  Unpack(const ReadObserver & observer)
  {
    if (m_Header.stored)
    {
      this->Resample<TValue>(observer);
      return;
    }
    const auto predicate = MakePredicate<TValue>(m_Settings);
    m_BytesRead = StreamValues<TValue>(
      m_Header, observer, [&](const std::vector<TValue> & values) { this->Append(values, predicate); });
  }

  template <typename TValue>
  void
  Resample(const ReadObserver & observer)
  {
    const auto          predicate = MakePredicate<double>(m_Settings);
    std::vector<double> values;
    SliceResampler      resampler(m_Header, m_Settings.interpolation, [&](const double * row, std::uint64_t count) {
      values.insert(values.end(), row, row + count);
      if (values.size() >= VoxelsPerChunk)
      {
        // Only the last words may have room.
        const auto end = values.begin() + static_cast<std::ptrdiff_t>(values.size() / BitStore::BitsPerWord) *
                                            static_cast<std::ptrdiff_t>(BitStore::BitsPerWord);
        const std::vector<double> rest(end, values.end());
        values.erase(end, values.end());
        this->Append(values, predicate);
        values = rest;
      }
    });
    m_BytesRead = StreamValues<TValue>(
      m_Header.GetStored(), observer, [&](const std::vector<TValue> & stored) { resampler.Append(stored); });
    this->Append(values, predicate);
  }

  template <typename TValue>
  void
  Append(const std::vector<TValue> & values, const itk::MedialVoxelObjectPredicate<TValue> & predicate)
  {
    m_Words.assign(GetBitStoreBytes(values.size()) / sizeof(BitStore::WordType), 0);
    this->Pack(values, predicate, m_Words);
    m_Bits->Append(m_Words);
  }

  template <typename TValue>
  void
  Pack(const std::vector<TValue> &                     values,
       const itk::MedialVoxelObjectPredicate<TValue> & predicate,
       std::vector<BitStore::WordType> &               words)
  {
    itk::MedialVoxelPackRow(values.data(), 0, static_cast<std::int64_t>(values.size()), predicate, words.data());
    if constexpr (std::is_floating_point<TValue>::value)
    {
      m_NotANumberVoxels += static_cast<std::uint64_t>(
        std::count_if(values.begin(), values.end(), [](TValue value) { return value != value; }));
    }
  }

  VolumeHeader                                 m_Header;
  UnpackSettings                               m_Settings;
  std::unique_ptr<BitStore>                    m_Bits;
  std::vector<BitStore::WordType>              m_Words; ///< of a chunk
  typename BitImageSource<VDimension>::Pointer m_Source = BitImageSource<VDimension>::New();
  std::uint64_t                                m_NotANumberVoxels{ 0 };
  std::uint64_t                                m_BytesRead{ 0 };
};

} // namespace

void
ExpandBits(const BitStore & bits, std::uint64_t firstVoxel, std::uint64_t count, unsigned char * pixels)
{
  constexpr std::uint64_t         wordsPerRead = std::uint64_t{ 1 } << 13;
  std::vector<BitStore::WordType> words;
  const std::uint64_t             end = firstVoxel + count;
  while (firstVoxel < end)
  {
    const std::uint64_t firstWord = firstVoxel / BitStore::BitsPerWord;
    const std::uint64_t lastWord = std::min((end - 1) / BitStore::BitsPerWord, firstWord + wordsPerRead - 1);
    words.resize(lastWord - firstWord + 1);
    bits.Read(firstWord, words.size(), words.data());
    const std::uint64_t stop = std::min(end, (lastWord + 1) * BitStore::BitsPerWord);
    ExpandWords(words.data(), firstVoxel - firstWord * BitStore::BitsPerWord, stop - firstVoxel, pixels);
    pixels += stop - firstVoxel;
    firstVoxel = stop;
  }
}

std::unique_ptr<InputVolume>
OpenMaskInput(const VolumeHeader & header, const UnpackSettings & settings)
{
  if (header.geometry.GetDimension() == 2)
  {
    return std::make_unique<MaskInput<2>>(header, settings);
  }
  return std::make_unique<MaskInput<3>>(header, settings);
}

} // end namespace medialvoxel
