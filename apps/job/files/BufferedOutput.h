// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelBufferedOutput_h
#define medialvoxelBufferedOutput_h

#include "OutputFile.h"

#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace medialvoxel
{

/** Shortest text that reads back as the same number, with a point in every locale. */
std::string
FormatFloat(float value);
std::string
FormatFloat(double value);

/** The bytes of a number of a file format, the low or the high one first. */
template <typename TNumber>
std::array<char, sizeof(TNumber)>
ToBytes(TNumber value, bool isLittleEndian)
{
  using Word = std::conditional_t<sizeof(TNumber) == 8,
                                  std::uint64_t,
                                  std::conditional_t<sizeof(TNumber) == 4, std::uint32_t, std::uint16_t>>;
  using Bits = std::conditional_t<sizeof(TNumber) == 1, std::uint8_t, Word>;
  Bits bits;
  static_assert(sizeof(bits) == sizeof(value));
  std::memcpy(&bits, &value, sizeof(value));
  std::array<char, sizeof(value)> bytes;
  for (size_t byte = 0; byte < sizeof(value); ++byte)
  {
    bytes[byte] = static_cast<char>(std::uint64_t{ bits } >> (8 * (isLittleEndian ? byte : sizeof(value) - 1 - byte)));
  }
  return bytes;
}

/** \class ByteBuffer
 * \brief Binary numbers for a part of a file, whatever machine. */
class ByteBuffer
{
public:
  template <typename TNumber>
  void
  LittleEndian(TNumber value)
  {
    const auto bytes = ToBytes(value, true);
    m_Bytes.insert(m_Bytes.end(), bytes.begin(), bytes.end());
  }

  std::string_view
  GetBytes() const
  {
    return { m_Bytes.data(), m_Bytes.size() };
  }

private:
  std::vector<char> m_Bytes;
};

/** \class BufferedOutput
 * \brief Writes a created, empty file from its begin to its end, binary or text, whatever machine and locale. */
class BufferedOutput
{
public:
  explicit BufferedOutput(OutputFile & file)
    : m_File(file)
  {}

  BufferedOutput &
  Text(std::string_view text);

  BufferedOutput &
  Integer(std::uint64_t value);

  /** As FormatFloat(). */
  BufferedOutput &
  Float(float value);
  BufferedOutput &
  Float(double value);

  /** A number of the file format with the low byte first. */
  template <typename TNumber>
  void
  LittleEndian(TNumber value)
  {
    this->Bytes(ToBytes(value, true));
  }

  /** A number of the file format with the high byte first. */
  template <typename TNumber>
  void
  BigEndian(TNumber value)
  {
    this->Bytes(ToBytes(value, false));
  }

  /** Writes the buffer and finishes the file. \throw JobError Failure. */
  void
  Finish();

private:
  template <std::size_t Size>
  void
  Bytes(const std::array<char, Size> & bytes)
  {
    if (m_Used + Size > m_Buffer.size())
    {
      this->Flush();
    }
    std::memcpy(m_Buffer.data() + m_Used, bytes.data(), Size);
    m_Used += Size;
  }

  void
  Flush();

  static constexpr size_t BufferSize = size_t{ 1 } << 20;

  OutputFile &      m_File;
  std::vector<char> m_Buffer = std::vector<char>(BufferSize);
  size_t            m_Used{ 0 };
  std::uint64_t     m_Offset{ 0 };
};

} // end namespace medialvoxel

#endif
