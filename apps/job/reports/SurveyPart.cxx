// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
// How a survey goes from one process to another: its numbers as variable lengths of seven bits, low ones first, so that
// zeros, which most of them are, take a byte; then packed by zlib.
#include "Errors.h"
#include "Survey.h"

#include "itk_zlib.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class NumberWriter
 * \brief Appends numbers to bytes. */
class NumberWriter
{
public:
  void
  Add(std::uint64_t number)
  {
    for (; number >= 128; number >>= 7)
    {
      m_Bytes.push_back(static_cast<char>(number | 128));
    }
    m_Bytes.push_back(static_cast<char>(number));
  }

  /** Small numbers of either sign stay short. */
  void
  AddSigned(std::int64_t number)
  {
    this->Add(static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63));
  }

  void
  AddAll(const std::vector<std::uint64_t> & numbers)
  {
    this->Add(numbers.size());
    std::for_each(numbers.begin(), numbers.end(), [this](std::uint64_t number) { this->Add(number); });
  }

  /** The number of bytes, eight of them, and the packed bytes. */
  std::string
  Pack() const
  {
    uLongf      length = compressBound(m_Bytes.size());
    std::string packed(8 + length, '\0');
    for (unsigned int i = 0; i < 8; ++i)
    {
      packed[i] = static_cast<char>(std::uint64_t{ m_Bytes.size() } >> (8 * i));
    }
    compress2(reinterpret_cast<Bytef *>(&packed[8]),
              &length,
              reinterpret_cast<const Bytef *>(m_Bytes.data()),
              m_Bytes.size(),
              Z_BEST_SPEED);
    packed.resize(8 + length);
    return packed;
  }

private:
  std::string m_Bytes;
};

/** Deflated bytes never become more; so a few of them do not take much memory before they are found to be damaged. */
constexpr std::uint64_t MostRatio = 1040;

[[noreturn]] void
RefusePart()
{
  throw JobError(ExitStatus::Failure, "a part of the survey is damaged or of another job");
}

/** \class NumberReader
 * \brief Takes them back; throws when they are not what a NumberWriter made. */
class NumberReader
{
public:
  /** \param mostBytes more than that are not unpacked */
  NumberReader(const std::string & packed, std::uint64_t mostBytes)
  {
    std::uint64_t size = 0;
    for (unsigned int i = 0; i < 8 && packed.size() > 8; ++i)
    {
      size |= std::uint64_t{ static_cast<std::uint8_t>(packed[i]) } << (8 * i);
    }
    if (size == 0 || size > mostBytes || size > MostRatio * packed.size())
    {
      RefusePart();
    }
    m_Bytes.resize(size);
    uLongf length = m_Bytes.size();
    if (uncompress(reinterpret_cast<Bytef *>(m_Bytes.data()),
                   &length,
                   reinterpret_cast<const Bytef *>(packed.data() + 8),
                   packed.size() - 8) != Z_OK ||
        length != m_Bytes.size())
    {
      RefusePart();
    }
  }

  std::uint64_t
  Get()
  {
    std::uint64_t number = 0;
    for (unsigned int shift = 0; m_Position < m_Bytes.size() && shift < 64; shift += 7)
    {
      const auto byte = static_cast<std::uint8_t>(m_Bytes[m_Position++]);
      number |= std::uint64_t{ byte & 127u } << shift;
      if (byte < 128)
      {
        return number;
      }
    }
    RefusePart();
  }

  std::int64_t
  GetSigned()
  {
    const std::uint64_t number = this->Get();
    return static_cast<std::int64_t>(number >> 1 ^ (0 - (number & 1)));
  }

  void
  AddTo(LengthHistogram & histogram)
  {
    const std::uint64_t size = this->Get();
    if (size > m_Bytes.size())
    {
      RefusePart();
    }
    for (std::uint64_t bin = 0; bin < size; ++bin)
    {
      const std::uint64_t number = this->Get();
      if (number > 0)
      {
        histogram.Add(bin, number);
      }
    }
  }

  void
  CheckEnd() const
  {
    if (m_Position != m_Bytes.size())
    {
      RefusePart();
    }
  }

private:
  std::string m_Bytes;
  std::size_t m_Position{ 0 };
};

} // namespace

std::string
Survey::Save() const
{
  NumberWriter numbers;
  numbers.AddAll(m_Total.thickness.GetNumbers());
  numbers.AddAll(m_Total.area.GetNumbers());
  numbers.AddAll(m_Total.uncertainty.GetNumbers());
  numbers.Add(m_Total.rimCells);
  numbers.Add(m_Total.unresolvedCells);
  for (const auto & slices : m_Total.slices)
  {
    numbers.Add(slices.size());
    for (const SliceSums & slice : slices)
    {
      numbers.AddSigned(slice.score);
      numbers.Add(slice.cells);
    }
  }
  numbers.Add(m_Total.projection.size());
  for (const ProjectedPixel & pixel : m_Total.projection)
  {
    numbers.Add(pixel.label);
    numbers.Add(pixel.medialCells);
    numbers.Add(pixel.thickest);
  }
  // Blocks as lengths of runs, first of those without labels.
  numbers.Add(m_Blocks.size());
  bool value = false;
  for (auto begin = m_Blocks.begin(); begin != m_Blocks.end(); value = !value)
  {
    const auto end = std::find(begin, m_Blocks.end(), !value);
    numbers.Add(static_cast<std::uint64_t>(end - begin));
    begin = end;
  }
  return numbers.Pack();
}

void
Survey::Merge(const std::string & bytes)
{
  // No more than ten bytes for a number, and as many numbers as a survey of this size can have.
  constexpr std::uint64_t mostBins = std::uint64_t{ 1 } << 22;
  std::uint64_t           mostNumbers = 3 * mostBins + 3 * m_Total.projection.size() + m_Blocks.size() + 9;
  for (const auto & slices : m_Total.slices)
  {
    mostNumbers += 2 * slices.size();
  }
  NumberReader numbers(bytes, 10 * mostNumbers);
  const auto   requireSize = [&numbers](std::size_t size) {
    if (numbers.Get() != size)
    {
      RefusePart();
    }
  };
  Sums part(m_Total.thickness.GetBinWidth());
  this->Resize(part);
  numbers.AddTo(part.thickness);
  numbers.AddTo(part.area);
  numbers.AddTo(part.uncertainty);
  part.rimCells = numbers.Get();
  part.unresolvedCells = numbers.Get();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    requireSize(m_Total.slices[axis].size());
    part.slices[axis].resize(m_Total.slices[axis].size());
    for (SliceSums & slice : part.slices[axis])
    {
      slice.score = numbers.GetSigned();
      slice.cells = numbers.Get();
    }
  }
  requireSize(m_Total.projection.size());
  for (ProjectedPixel & pixel : part.projection)
  {
    pixel.label = static_cast<std::uint8_t>(numbers.Get());
    pixel.medialCells = static_cast<std::uint32_t>(numbers.Get());
    pixel.thickest = static_cast<std::uint32_t>(numbers.Get());
  }
  requireSize(m_Blocks.size());
  std::vector<bool> blocks;
  for (bool value = false; blocks.size() < m_Blocks.size(); value = !value)
  {
    const std::uint64_t length = numbers.Get();
    if (length > m_Blocks.size() - blocks.size() || (length == 0 && !blocks.empty()))
    {
      RefusePart();
    }
    blocks.insert(blocks.end(), length, value);
  }
  numbers.CheckEnd();
  this->AddToTotal(part);
  std::transform(m_Blocks.begin(), m_Blocks.end(), blocks.begin(), m_Blocks.begin(), std::logical_or<>());
}

} // end namespace medialvoxel
