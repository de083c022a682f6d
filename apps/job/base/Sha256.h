// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSha256_h
#define medialvoxelSha256_h

#include <array>
#include <cstdint>
#include <string>

namespace medialvoxel
{

/** \class Sha256
 * \brief The secure hash SHA-256 of FIPS 180-4, of bytes that come in parts. */
class Sha256
{
public:
  void
  Add(const void * data, std::uint64_t numberOfBytes);

  /** 64 hexadecimal digits of all that was added; to be called once, at the end. */
  std::string
  Finish();

private:
  void
  AddBlock(const std::uint8_t * block);

  std::array<std::uint32_t, 8> m_State{
    { 0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19 }
  };
  std::array<std::uint8_t, 64> m_Rest{};
  std::uint64_t                m_NumberOfBytes{ 0 };
};

} // end namespace medialvoxel

#endif
