// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TiffCodecs.h"

#include "itkMedialVoxelFileRegion.h"
#include "itk_zlib.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace medialvoxel
{
namespace
{

/** \class CodeReader
 * \brief Codes of 9 to 12 bits, the highest bit first. */
class CodeReader
{
public:
  explicit CodeReader(const std::vector<unsigned char> & bytes)
    : m_Bytes(bytes)
  {}

  /** False at the end. */
  bool
  Next(unsigned int numberOfBits, unsigned int & code)
  {
    while (m_NumberOfBits < numberOfBits)
    {
      if (m_Position == m_Bytes.size())
      {
        return false;
      }
      m_Bits = (m_Bits << 8) | m_Bytes[m_Position++];
      m_NumberOfBits += 8;
    }
    m_NumberOfBits -= numberOfBits;
    code = (m_Bits >> m_NumberOfBits) & ((1u << numberOfBits) - 1u);
    return true;
  }

private:
  const std::vector<unsigned char> & m_Bytes;
  size_t                             m_Position{ 0 };
  std::uint32_t                      m_Bits{ 0 };
  unsigned int                       m_NumberOfBits{ 0 };
};

/** \class CodeTable
 * \brief The texts that codes stand for: each is another one and a byte. */
class CodeTable
{
public:
  static constexpr unsigned int Clear = 256;
  static constexpr unsigned int End = 257;
  static constexpr unsigned int First = 258;
  static constexpr unsigned int Size = 4096;

  unsigned int
  GetNext() const
  {
    return m_Next;
  }

  void
  Reset()
  {
    m_Next = First;
  }

  void
  Add(unsigned int prefix, unsigned char last)
  {
    if (m_Next < Size)
    {
      m_Prefix[m_Next] = static_cast<std::uint16_t>(prefix);
      m_Last[m_Next] = last;
      m_Length[m_Next] = static_cast<std::uint16_t>(this->GetLength(prefix) + 1);
      ++m_Next;
    }
  }

  unsigned int
  GetLength(unsigned int code) const
  {
    return code < Clear ? 1 : m_Length[code];
  }

  /** Writes a text where it fits, from its end on, and returns its first byte. */
  unsigned char
  Write(unsigned int code, std::vector<unsigned char> & text, std::uint64_t begin) const
  {
    for (std::uint64_t position = begin + this->GetLength(code) - 1; code >= First; --position)
    {
      if (position < text.size())
      {
        text[position] = m_Last[code];
      }
      code = m_Prefix[code];
    }
    if (begin < text.size())
    {
      text[begin] = static_cast<unsigned char>(code);
    }
    return static_cast<unsigned char>(code);
  }

private:
  std::array<std::uint16_t, Size> m_Prefix{};
  std::array<std::uint16_t, Size> m_Length{};
  std::array<unsigned char, Size> m_Last{};
  unsigned int                    m_Next{ First };
};

/** The width of codes grows one code before it must: a rule of the format. */
unsigned int
GetWidth(unsigned int nextCode)
{
  return nextCode < 511 ? 9 : (nextCode < 1023 ? 10 : (nextCode < 2047 ? 11 : 12));
}

template <typename TUnsigned>
void
SumRows(std::vector<unsigned char> & rows, std::uint64_t numbersPerRow, bool bigEndian)
{
  const bool swap = bigEndian != itk::MachineIsBigEndian();
  if (swap)
  {
    itk::SwapComponentBytes(rows.data(), rows.size(), sizeof(TUnsigned));
  }
  const std::uint64_t numbers = rows.size() / sizeof(TUnsigned);
  TUnsigned           sum = 0;
  for (std::uint64_t number = 0; number < numbers; ++number)
  {
    unsigned char * const place = rows.data() + number * sizeof(TUnsigned);
    TUnsigned             difference = 0;
    std::memcpy(&difference, place, sizeof(difference));
    sum = static_cast<TUnsigned>(number % numbersPerRow == 0 ? difference : sum + difference);
    std::memcpy(place, &sum, sizeof(sum));
  }
  if (swap)
  {
    itk::SwapComponentBytes(rows.data(), rows.size(), sizeof(TUnsigned));
  }
}

} // namespace

bool
UnpackLzw(const std::vector<unsigned char> & packed, std::vector<unsigned char> & unpacked)
{
  CodeReader    codes(packed);
  CodeTable     table;
  std::uint64_t done = 0;
  unsigned int  previous = CodeTable::Clear;
  unsigned int  code = 0;
  while (done < unpacked.size())
  {
    if (!codes.Next(GetWidth(table.GetNext()), code) || code == CodeTable::End)
    {
      return false;
    }
    if (code == CodeTable::Clear)
    {
      table.Reset();
      previous = CodeTable::Clear;
      continue;
    }
    const bool isNew = code == table.GetNext();
    if ((previous == CodeTable::Clear && code > CodeTable::Clear) || (!isNew && code > table.GetNext()))
    {
      return false;
    }
    if (isNew)
    {
      // The only text that is used before it is known: the previous one and its own first byte.
      const unsigned char first = table.Write(previous, unpacked, done);
      table.Add(previous, first);
    }
    if (code >= table.GetNext())
    {
      return false;
    }
    const unsigned char first = table.Write(code, unpacked, done);
    if (!isNew && previous != CodeTable::Clear)
    {
      table.Add(previous, first);
    }
    done += table.GetLength(code);
    previous = code;
  }
  return true;
}

bool
UnpackPackBits(const std::vector<unsigned char> & packed, std::vector<unsigned char> & unpacked)
{
  size_t position = 0;
  size_t done = 0;
  while (done < unpacked.size())
  {
    if (position == packed.size())
    {
      return false;
    }
    const unsigned int length = packed[position++];
    const size_t       rest = unpacked.size() - done;
    if (length < 128)
    {
      const size_t count = std::min<size_t>(length + 1, rest);
      if (packed.size() - position < count)
      {
        return false;
      }
      std::copy_n(packed.data() + position, count, unpacked.data() + done);
      position += count;
      done += count;
    }
    else if (length > 128)
    {
      const size_t count = std::min<size_t>(257 - length, rest);
      if (position == packed.size())
      {
        return false;
      }
      std::fill_n(unpacked.data() + done, count, packed[position++]);
      done += count;
    }
  }
  return true;
}

bool
UnpackDeflate(const std::vector<unsigned char> & packed, std::vector<unsigned char> & unpacked)
{
  uLongf    size = unpacked.size();
  const int result = uncompress(unpacked.data(), &size, packed.data(), packed.size());
  return result == Z_OK && size == unpacked.size();
}

void
SumDifferences(std::vector<unsigned char> & rows,
               std::uint64_t                numbersPerRow,
               unsigned int                 bytesPerNumber,
               bool                         bigEndian)
{
  switch (bytesPerNumber)
  {
    case 1:
      return SumRows<std::uint8_t>(rows, numbersPerRow, bigEndian);
    case 2:
      return SumRows<std::uint16_t>(rows, numbersPerRow, bigEndian);
    case 4:
      return SumRows<std::uint32_t>(rows, numbersPerRow, bigEndian);
    default:
      return SumRows<std::uint64_t>(rows, numbersPerRow, bigEndian);
  }
}

} // end namespace medialvoxel
