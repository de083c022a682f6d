// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomFrames_h
#define medialvoxelDicomFrames_h

#include "DicomStructure.h"
#include "SliceSeries.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** One of the images of a DICOM file. */
struct DicomFrame
{
  std::shared_ptr<const DicomStructure> file;
  std::uint64_t                         number{ 0 }; ///< from 0
  std::size_t                           beginOfFragments{ 0 };
  std::size_t                           endOfFragments{ 0 };
  double                                slope{ 1.0 };
  double                                intercept{ 0.0 };
  std::uint64_t                         fileSize{ 0 };
  std::filesystem::file_time_type       lastWrite; ///< of the file
};

/** Places and scales of all images, in the order of the file; the type of their values is not set.
 * \throw HeaderError */
std::vector<SliceHeader>
ListDicomFrames(const std::filesystem::path & fileName, DicomStructure structure);

/** The numbers of one frame as they are stored, packed or in the byte order of this machine.
 * \throw HeaderError when the file is another one than before */
std::vector<char>
ReadDicomFrame(const SliceHeader & slice);

} // end namespace medialvoxel

#endif
