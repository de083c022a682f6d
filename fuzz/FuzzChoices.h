// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzChoices_h
#define FuzzChoices_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace MedialVoxelFuzz
{

/** \class Choices
 * \brief Takes numbers from the bytes of an input, 0 behind its end. */
class Choices
{
public:
  Choices(const std::uint8_t * data, std::size_t size)
    : m_Data(data)
    , m_Size(size)
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      m_Checksum = (m_Checksum ^ data[i]) * 1099511628211U;
    }
  }

  unsigned int
  Byte()
  {
    return m_Position < m_Size ? m_Data[m_Position++] : 0;
  }

  int
  Next(int low, int high)
  {
    return low + static_cast<int>(this->Byte()) % (high - low + 1);
  }

  bool
  Flag()
  {
    return this->Next(0, 1) == 1;
  }

  template <typename TValue, std::size_t N>
  TValue
  OneOf(const std::array<TValue, N> & values)
  {
    return values[static_cast<std::size_t>(this->Next(0, static_cast<int>(N) - 1))];
  }

  /** True for one of so many inputs. All bytes decide, so that a fuzzer that prefers the larger cases cannot have more
   * of them. */
  bool
  Rarely(unsigned int times)
  {
    m_Checksum = m_Checksum * 6364136223846793005U + 1442695040888963407U;
    return (m_Checksum >> 33) % times == 0;
  }

  bool
  IsAtEnd() const
  {
    return m_Position >= m_Size;
  }

private:
  const std::uint8_t * m_Data;
  std::size_t          m_Size;
  std::size_t          m_Position{ 0 };
  std::uint64_t        m_Checksum{ 14695981039346656037U };
};

} // namespace MedialVoxelFuzz

#endif
