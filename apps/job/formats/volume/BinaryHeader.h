// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelBinaryHeader_h
#define medialvoxelBinaryHeader_h

#include "itkMedialVoxelFileRegion.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** \class BinaryHeader
 * \brief Bytes of a header, from which numbers of either byte order are taken. */
class BinaryHeader
{
public:
  BinaryHeader() = default;

  BinaryHeader(std::vector<unsigned char> bytes, bool bigEndian)
    : m_Bytes(std::move(bytes))
    , m_BigEndian(bigEndian)
  {}

  /** The number at an offset. \throw std::out_of_range */
  template <typename TNumber>
  TNumber
  Get(std::size_t offset) const
  {
    if (offset > m_Bytes.size() || m_Bytes.size() - offset < sizeof(TNumber))
    {
      throw std::out_of_range("a number behind the end of a header");
    }
    TNumber number{};
    std::memcpy(&number, m_Bytes.data() + offset, sizeof(number));
    if (m_BigEndian != itk::MachineIsBigEndian())
    {
      itk::SwapComponentBytes(&number, sizeof(number), sizeof(number));
    }
    return number;
  }

private:
  std::vector<unsigned char> m_Bytes;
  bool                       m_BigEndian{ false };
};

} // end namespace medialvoxel

#endif
