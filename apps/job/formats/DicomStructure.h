// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomStructure_h
#define medialvoxelDicomStructure_h

#include <cstdint>
#include <filesystem>

namespace medialvoxel
{

/** What decides how much memory the image of a DICOM file takes. */
struct DicomStructure
{
  std::uint64_t columns{ 0 };
  std::uint64_t rows{ 0 };
  std::uint64_t samples{ 1 };
  std::uint64_t bits{ 0 };       ///< allocated for a sample
  std::uint64_t storedBits{ 0 }; ///< of the allocated ones
  std::uint64_t highBit{ 0 };    ///< of the stored ones
  std::uint64_t isSigned{ 0 };   ///< 0 or 1
  std::uint64_t voxelBytes{ 0 }; ///< in the file, packed or not; 0: the file has no image
  bool          isPacked{ false };
  std::uint64_t endOfVoxels{ 0 }; ///< where what follows the image begins
};

/** Whether a file has the signature of DICOM. */
bool
IsDicomFile(const std::filesystem::path & fileName);

/** Walks through all elements of a DICOM file, items of sequences included: GDCM allocates what their lengths say
 * before it reads. \throw HeaderError when one does not fit into what is around it, or the transfer syntax is not read
 */
DicomStructure
CheckDicomStructure(const std::filesystem::path & fileName);

} // end namespace medialvoxel

#endif
