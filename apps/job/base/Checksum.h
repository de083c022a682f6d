// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelChecksum_h
#define medialvoxelChecksum_h

#include <cstdint>
#include <string>

namespace medialvoxel
{

/** \class Checksum
 * \brief CRC-32 as of zlib and gzip, of bytes that come in parts. */
class Checksum
{
public:
  void
  Add(const void * data, std::uint64_t numberOfBytes);

  std::uint32_t
  GetValue() const
  {
    return m_Value;
  }

private:
  std::uint32_t m_Value{ 0 };
};

/** The checksum of a whole text. */
std::uint32_t
GetChecksum(const std::string & text);

} // end namespace medialvoxel

#endif
