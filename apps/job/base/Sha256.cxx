// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Sha256.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t BlockBytes = 64;

constexpr std::array<std::uint32_t, 64> Constants{
  { 0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2 }
};

std::uint32_t
RotateRight(std::uint32_t word, unsigned int bits)
{
  return word >> bits | word << (32 - bits);
}

/** Words 0 to 15 are those of the block, the others follow from them. */
std::array<std::uint32_t, 64>
MakeSchedule(const std::uint8_t * block)
{
  std::array<std::uint32_t, 64> words{};
  for (unsigned int i = 0; i < 16; ++i)
  {
    words[i] = std::uint32_t{ block[4 * i] } << 24 | std::uint32_t{ block[4 * i + 1] } << 16 |
               std::uint32_t{ block[4 * i + 2] } << 8 | std::uint32_t{ block[4 * i + 3] };
  }
  for (unsigned int i = 16; i < 64; ++i)
  {
    const std::uint32_t a = words[i - 15];
    const std::uint32_t b = words[i - 2];
    words[i] = words[i - 16] + (RotateRight(a, 7) ^ RotateRight(a, 18) ^ a >> 3) + words[i - 7] +
               (RotateRight(b, 17) ^ RotateRight(b, 19) ^ b >> 10);
  }
  return words;
}

} // namespace

void
Sha256::AddBlock(const std::uint8_t * block)
{
  const auto                   words = MakeSchedule(block);
  std::array<std::uint32_t, 8> s = m_State;
  for (unsigned int i = 0; i < 64; ++i)
  {
    const std::uint32_t choice = (s[4] & s[5]) ^ (~s[4] & s[6]);
    const std::uint32_t majority = (s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]);
    const std::uint32_t first =
      s[7] + (RotateRight(s[4], 6) ^ RotateRight(s[4], 11) ^ RotateRight(s[4], 25)) + choice + Constants[i] + words[i];
    const std::uint32_t second = (RotateRight(s[0], 2) ^ RotateRight(s[0], 13) ^ RotateRight(s[0], 22)) + majority;
    s = { { first + second, s[0], s[1], s[2], s[3] + first, s[4], s[5], s[6] } };
  }
  for (unsigned int i = 0; i < 8; ++i)
  {
    m_State[i] += s[i];
  }
}

void
Sha256::Add(const void * data, std::uint64_t numberOfBytes)
{
  const auto * bytes = static_cast<const std::uint8_t *>(data);
  while (numberOfBytes > 0)
  {
    const std::uint64_t begin = m_NumberOfBytes % BlockBytes;
    const std::uint64_t part = std::min(BlockBytes - begin, numberOfBytes);
    std::memcpy(m_Rest.data() + begin, bytes, part);
    m_NumberOfBytes += part;
    bytes += part;
    numberOfBytes -= part;
    if (m_NumberOfBytes % BlockBytes == 0)
    {
      this->AddBlock(m_Rest.data());
    }
  }
}

std::string
Sha256::Finish()
{
  const std::uint64_t         bits = 8 * m_NumberOfBytes;
  constexpr std::uint8_t      one = 0x80;
  constexpr std::uint8_t      zero = 0;
  std::array<std::uint8_t, 8> length{};
  for (unsigned int i = 0; i < 8; ++i)
  {
    length[i] = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
  }
  this->Add(&one, 1);
  while (m_NumberOfBytes % BlockBytes != BlockBytes - length.size())
  {
    this->Add(&zero, 1);
  }
  this->Add(length.data(), length.size());
  std::string text;
  for (const std::uint32_t word : m_State)
  {
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x", static_cast<unsigned int>(word));
    text += digits.data();
  }
  return text;
}

} // end namespace medialvoxel
