// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Checksum.h"

#include "itk_zlib.h"

#include <algorithm>

namespace medialvoxel
{

void
Checksum::Add(const void * data, std::uint64_t numberOfBytes)
{
  constexpr std::uint64_t most = std::uint64_t{ 1 } << 30; // zlib counts in 32 bits
  const auto *            bytes = static_cast<const Bytef *>(data);
  while (numberOfBytes > 0)
  {
    const std::uint64_t part = std::min(numberOfBytes, most);
    m_Value = static_cast<std::uint32_t>(crc32(m_Value, bytes, static_cast<uInt>(part)));
    bytes += part;
    numberOfBytes -= part;
  }
}

std::uint32_t
GetChecksum(const std::string & text)
{
  Checksum checksum;
  checksum.Add(text.data(), text.size());
  return checksum.GetValue();
}

} // end namespace medialvoxel
