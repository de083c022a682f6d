// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MaskInput.h"

#include "BitStore.h"
#include "ObjectValues.h"
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

using WordType = BitStore::WordType;

/** \a count bits, 1 to 64, of \a words from bit \a first on. */
WordType
GetBits(const WordType * words, std::uint64_t first, std::uint64_t count)
{
  const WordType *    word = words + first / BitStore::BitsPerWord;
  const std::uint64_t shift = first % BitStore::BitsPerWord;
  WordType            bits = word[0] >> shift;
  if (shift + count > BitStore::BitsPerWord)
  {
    bits |= word[1] << (BitStore::BitsPerWord - shift);
  }
  return count == BitStore::BitsPerWord ? bits : bits & ((WordType{ 1 } << count) - 1);
}

/** Sets those of \a count bits from \a first on in a row, from \a x on; \a row points to its word 0. */
void
SetBits(const WordType * words, std::uint64_t first, std::int64_t x, std::int64_t count, WordType * row)
{
  constexpr std::int64_t bitsPerWord = BitStore::BitsPerWord;
  for (const std::int64_t end = x + count; x < end;)
  {
    const std::int64_t next = std::min((x / bitsPerWord + 1) * bitsPerWord, end);
    const auto         number = static_cast<std::uint64_t>(next - x);
    row[x / bitsPerWord] |= GetBits(words, first, number) << (x % bitsPerWord);
    first += number;
    x = next;
  }
}

/** \class MaskInput
 * \brief One bit per voxel, made once. */
class MaskInput : public InputVolume
{
public:
  MaskInput(const VolumeHeader &          header,
            const JobOptions &            options,
            Interpolation                 interpolation,
            const std::filesystem::path & scratchFolder)
    : m_Header(header)
    , m_Options(options)
    , m_Interpolation(interpolation)
    , m_ScratchFolder(scratchFolder)
    , m_Bits(scratchFolder.empty() ? MakeBitStoreInMemory(header.geometry.GetNumberOfVoxels())
                                   : MakeBitStoreInFile(scratchFolder, header.geometry.GetNumberOfVoxels()))
  {}

  std::string
  Prepare(const ReadObserver & observer) override
  {
    this->MeasureReading(
      [&] { DispatchValueType(m_Header.GetStored(), [&](auto zero) { this->Unpack<decltype(zero)>(observer); }); });
    return m_Header.fileName.string() +
           (m_Header.compressed ? " is compressed and was unpacked once: " : " has scaled values and was read once: ") +
           FormatBytes(m_BytesRead) + " read, " + FormatBytes(GetBitStoreBytes(m_Header.geometry.GetNumberOfVoxels())) +
           " of mask " + (m_ScratchFolder.empty() ? "in memory" : "in " + m_ScratchFolder.string()) + ", " +
           FormatSeconds(this->GetReadSeconds());
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

  template <typename TValue>
  void
  Unpack(const ReadObserver & observer)
  {
    if (m_Header.stored)
    {
      this->Resample<TValue>(observer);
      return;
    }
    const auto predicate = MakeObjectPredicate<TValue>(m_Options);
    m_BytesRead = StreamValues<TValue>(
      m_Header, observer, [&](const std::vector<TValue> & values) { this->Append(values, predicate); });
  }

  template <typename TValue>
  void
  Resample(const ReadObserver & observer)
  {
    const auto          predicate = MakeObjectPredicate<double>(m_Options);
    std::vector<double> values;
    SliceResampler      resampler(m_Header, m_Interpolation, [&](const double * row, std::uint64_t count) {
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
      SetBits(m_Words.data(), first, part.lower[0], part.Extent(0), row);
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

  VolumeHeader                    m_Header;
  JobOptions                      m_Options;
  Interpolation                   m_Interpolation;
  std::filesystem::path           m_ScratchFolder;
  std::unique_ptr<BitStore>       m_Bits;
  std::vector<BitStore::WordType> m_Words; ///< of a chunk, or a slice of a part
  std::uint64_t                   m_NotANumberVoxels{ 0 };
  std::uint64_t                   m_BytesRead{ 0 };
};

} // namespace

std::unique_ptr<InputVolume>
OpenMaskInput(const VolumeHeader &          header,
              const JobOptions &            options,
              Interpolation                 interpolation,
              const std::filesystem::path & scratchFolder)
{
  return std::make_unique<MaskInput>(header, options, interpolation, scratchFolder);
}

} // end namespace medialvoxel
