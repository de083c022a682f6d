// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomModule_h
#define medialvoxelDicomModule_h

#include <cstdint>

// What the module that links GDCM gives the program, in plain types, since the program loads it only for DICOM files:
// GDCM's tables take 20 ms and 10 MiB in each process that has it.

extern "C"
{
  /** What the header of a DICOM file with one gray image says. Lengths are in millimeters. */
  struct MedialVoxelDicomHeader
  {
    std::uint32_t columns;
    std::uint32_t rows;
    std::uint32_t pixelType;   ///< medialvoxel::PixelType of the values after rescale slope and intercept
    std::uint32_t hasPosition; ///< 0: origin and directions mean nothing
    std::uint32_t hasSpacing;  ///< 0: the spacing is a guess
    std::uint32_t hasNumber;   ///< 0: the number means nothing
    std::int64_t  number;      ///< of the instance
    double        rounding;    ///< of the position: half of the last digit that is written
    double        slope;       ///< of the rescaled values
    double        intercept;
    double        spacing[2]; ///< between columns, and between rows
    double        origin[3];
    double        directions[6]; ///< of increasing columns, then of increasing rows
    char          series[65];    ///< instance UID of the series
    char          description[65];
    char          acquisition[65]; ///< what tells scans of one series apart; empty: nothing does
  };

  /** One of several frames of a file, and the numbers that it is stored as. */
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

  /** \return null, or what is wrong, which holds until the next call of the thread */
  using MedialVoxelReadDicomHeader = const char * (*)(const char * fileName, MedialVoxelDicomHeader * header);

  /** Reads the values, rescaled, row by row, when the header still says the same. No byte from \a end on is read.
   * \return null, or what is wrong, which holds until the next call of the thread */
  using MedialVoxelReadDicomVoxels = const char * (*)(const char *                   fileName,
                                                      std::uint64_t                  end,
                                                      const MedialVoxelDicomHeader * header,
                                                      void *                         voxels);

  /** Tells the medialvoxel::PixelType of the values of a frame and, when its bytes are at hand, the values, rescaled.
   * \return null, or what is wrong, which holds until the next call of the thread */
  using MedialVoxelReadDicomFrame = const char * (*)(const MedialVoxelDicomFrame * frame,
                                                     std::uint32_t *               pixelType,
                                                     void *                        voxels);
}

/** Names of the functions in the module. */
constexpr const char * MedialVoxelReadDicomHeaderName = "MedialVoxelModuleReadDicomHeader";
constexpr const char * MedialVoxelReadDicomVoxelsName = "MedialVoxelModuleReadDicomVoxels";
constexpr const char * MedialVoxelReadDicomFrameName = "MedialVoxelModuleReadDicomFrame";

#endif
