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
    this->Bytes(value, 0, 1);
  }

  /** A number of the file format with the high byte first. */
  template <typename TNumber>
  void
  BigEndian(TNumber value)
  {
    this->Bytes(value, sizeof(TNumber) - 1, -1);
  }

  /** Writes the buffer and finishes the file. \throw JobError Failure. */
  void
  Finish();

private:
  template <typename TNumber>
  void
  Bytes(TNumber value, int firstByte, int step)
  {
    using Word = std::conditional_t<sizeof(TNumber) == 8,
                                    std::uint64_t,
                                    std::conditional_t<sizeof(TNumber) == 4, std::uint32_t, std::uint16_t>>;
    using Bits = std::conditional_t<sizeof(TNumber) == 1, std::uint8_t, Word>;
    Bits bits;
    static_assert(sizeof(bits) == sizeof(value));
    std::memcpy(&bits, &value, sizeof(value));
    std::array<char, sizeof(value)> bytes;
    for (size_t byte = 0; byte < sizeof(value); ++byte, firstByte += step)
    {
      bytes[byte] = static_cast<char>(std::uint64_t{ bits } >> (8 * firstByte));
    }
    if (m_Used + sizeof(value) > m_Buffer.size())
    {
      this->Flush();
    }
    std::memcpy(m_Buffer.data() + m_Used, bytes.data(), sizeof(value));
    m_Used += sizeof(value);
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
