// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomStructure_h
#define medialvoxelDicomStructure_h

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Values of elements about place, scale and series, by their tags. */
using DicomTexts = std::map<std::uint32_t, std::string>;

/** More are not believed. */
constexpr std::uint64_t MostDicomFrames = std::uint64_t{ 1 } << 16;

/** A piece of packed voxels. */
struct DicomFragment
{
  std::uint64_t mark; ///< where its tag begins
  std::uint64_t begin;
  std::uint64_t length;
};

/** Decides how much memory the image of a DICOM file takes. */
struct DicomStructure
{
  std::uint64_t frames{ 1 };
  std::uint64_t columns{ 0 };
  std::uint64_t rows{ 0 };
  std::uint64_t samples{ 1 };
  std::uint64_t bits{ 0 };       ///< allocated for a sample
  std::uint64_t storedBits{ 0 }; ///< of the allocated ones
  std::uint64_t highBit{ 0 };    ///< of the stored ones
  std::uint64_t isSigned{ 0 };   ///< 0 or 1
  std::uint64_t dataSize{ 0 };   ///< in the file, packed or not; 0: the file has no image
  bool          isPacked{ false };
  std::uint64_t beginOfVoxels{ 0 };
  std::uint64_t endOfVoxels{ 0 }; ///< where the bytes behind the image begin

  std::string   syntax;           ///< of the transfer
  std::uint64_t beginOfData{ 0 }; ///< behind the part that is always written in the same way
  bool          isBigEndian{ false };
  bool          isDeflated{ false }; ///< all places count unpacked bytes from the begin of the data on

  std::vector<DicomFragment> fragments; ///< of packed voxels
  std::vector<std::uint32_t> marks;     ///< of the first fragment of each frame, from that of the first one on

  DicomTexts              texts;           ///< of the file
  DicomTexts              textsOfFrames;   ///< that all frames share
  std::vector<DicomTexts> textsOfOneFrame; ///< in the order of the frames; empty: there are none
};

/** Whether a file has the signature of DICOM. */
bool
IsDicomFile(const std::filesystem::path & fileName);

/** Walks through all elements of a DICOM file, items of sequences included. \throw HeaderError when one does not fit
 * into its parent, or the transfer syntax is not read */
DicomStructure
CheckDicomStructure(const std::filesystem::path & fileName);

} // end namespace medialvoxel

#endif
