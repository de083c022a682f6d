// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Checksum.h"

#include "Zeros.h"

#include "itkMedialVoxelProgress.h"
#include "itk_zlib.h"

#include <algorithm>
#include <array>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t BlockSize = 4096;

std::uint32_t
GetChecksumOfZeros()
{
  constexpr std::array<Bytef, BlockSize> zeros{};
  return static_cast<std::uint32_t>(crc32(0, zeros.data(), BlockSize));
}

} // namespace

/** The effect of a block of zeros is known in advance; most of a label volume is zeros. */
void
Checksum::Add(const void * data, std::uint64_t numberOfBytes)
{
  static const std::uint32_t   ofZeros = GetChecksumOfZeros();
  const auto *                 bytes = static_cast<const Bytef *>(data);
  itk::MedialVoxelAbortChecker checker;
  while (numberOfBytes > 0)
  {
    const std::uint64_t part = std::min(numberOfBytes, BlockSize);
    checker.Count(static_cast<std::uint32_t>(part / 64));
    const bool isZeros = part == BlockSize && IsAllZero(reinterpret_cast<const char *>(bytes), part);
    m_Value = static_cast<std::uint32_t>(isZeros ? crc32_combine(m_Value, ofZeros, BlockSize)
                                                 : crc32(m_Value, bytes, static_cast<uInt>(part)));
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
