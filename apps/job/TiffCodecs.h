// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffCodecs_h
#define medialvoxelTiffCodecs_h

#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** Unpack a strip into a buffer of the size that it must have. What is more than that is dropped, as writers may pad.
 * \return false when the packed bytes are damaged or too few */
bool
UnpackLzw(const std::vector<unsigned char> & packed, std::vector<unsigned char> & unpacked);
bool
UnpackPackBits(const std::vector<unsigned char> & packed, std::vector<unsigned char> & unpacked);
bool
UnpackDeflate(const std::vector<unsigned char> & packed, std::vector<unsigned char> & unpacked);

/** Sums up the differences of rows of whole numbers, which are in the byte order of the file. */
void
SumDifferences(std::vector<unsigned char> & rows,
               std::uint64_t                numbersPerRow,
               unsigned int                 bytesPerNumber,
               bool                         bigEndian);

} // end namespace medialvoxel

#endif
