// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Crc32c.h"

#include <array>

namespace medialvoxel
{
namespace
{

using Table = std::array<std::uint32_t, 256>;

constexpr Table
MakeTable()
{
  constexpr std::uint32_t reversedPolynomial = 0x82F63B78u;
  constexpr int           bitsPerByte = 8;
  Table                   table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte)
  {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < bitsPerByte; ++bit)
    {
      rest = (rest >> 1) ^ ((rest & 1) != 0 ? reversedPolynomial : 0);
    }
    table[byte] = rest;
  }
  return table;
}

} // namespace

std::uint32_t
GetCrc32c(std::string_view bytes)
{
  static constexpr Table table = MakeTable();
  std::uint32_t          rest = ~std::uint32_t{ 0 };
  for (const char byte : bytes)
  {
    rest = table[(rest ^ static_cast<unsigned char>(byte)) & 0xFF] ^ (rest >> 8);
  }
  return ~rest;
}

std::optional<std::string_view>
CheckCrc32c(std::string_view bytesAndChecksum)
{
  constexpr std::size_t checksumSize = 4;
  if (bytesAndChecksum.size() < checksumSize)
  {
    return std::nullopt;
  }
  const std::string_view bytes = bytesAndChecksum.substr(0, bytesAndChecksum.size() - checksumSize);
  std::uint32_t          stored = 0;
  for (std::size_t i = checksumSize; i > 0; --i)
  {
    stored = (stored << 8) | static_cast<unsigned char>(bytesAndChecksum[bytes.size() + i - 1]);
  }
  return stored == GetCrc32c(bytes) ? std::optional<std::string_view>(bytes) : std::nullopt;
}

} // end namespace medialvoxel
