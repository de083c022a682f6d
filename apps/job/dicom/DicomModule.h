// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomModule_h
#define medialvoxelDicomModule_h

#include <cstdint>

// The interface of the module that links GDCM, in plain types. The program loads it for DICOM files only, since GDCM's
// tables take 20 ms and 10 MiB in each process that has it.

extern "C"
{
  /** One image of a file, and the numbers that it is stored as. */
  struct MedialVoxelDicomFrame
  {
    const char *  bytes;    ///< in the byte order of this machine, or packed; null: none are at hand
    std::uint64_t length;   ///< of the bytes
    const char *  syntax;   ///< transfer syntax of packed ones
    std::uint32_t isPacked; ///< 0 or 1
    std::uint32_t columns;
    std::uint32_t rows;
    std::uint32_t bits; ///< allocated
    std::uint32_t storedBits;
    std::uint32_t isSigned; ///< 0 or 1
    double        slope;
    double        intercept;
  };

  /** Gets the medialvoxel::PixelType of the values of a frame and, when its bytes are at hand, the rescaled values.
   * \return null, or an error text valid until the thread's next call */
  using MedialVoxelReadDicomFrame = const char * (*)(const MedialVoxelDicomFrame * frame,
                                                     std::uint32_t *               pixelType,
                                                     void *                        voxels);
}

/** Name of the function in the module. */
constexpr const char * MedialVoxelReadDicomFrameName = "MedialVoxelModuleReadDicomFrame";

#endif
