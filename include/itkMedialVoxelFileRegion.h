// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFileRegion_h
#define itkMedialVoxelFileRegion_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace itk
{

/** A stretch of voxel bytes in a file. Several of them, one after the other, make up a volume. */
struct MedialVoxelFileSegment
{
  std::filesystem::path fileName;
  std::uint64_t         offset{ 0 };
  std::uint64_t         numberOfBytes{ 0 };
};

/** \class MedialVoxelFileRegion
 * \brief A box of voxels within the bytes of a volume: the runs that lie one after the other in both.
 *
 * Voxels lie x fastest. Offsets count from the first byte of the first voxel and are 64 bits wide.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelFileRegion
{
public:
  /** \param size voxels of the volume along each axis
   * \param index first voxel of the box, \param extent its voxels along each axis; the box lies in the volume
   * \param bytesPerVoxel bytes of all components of a voxel */
  MedialVoxelFileRegion(const std::vector<std::uint64_t> & size,
                        const std::vector<std::uint64_t> & index,
                        const std::vector<std::uint64_t> & extent,
                        std::uint64_t                      bytesPerVoxel);

  std::uint64_t
  GetNumberOfRuns() const;

  std::uint64_t
  GetBytesPerRun() const
  {
    return m_BytesPerRun;
  }

  std::uint64_t
  GetNumberOfBytes() const
  {
    return GetNumberOfRuns() * m_BytesPerRun;
  }

  /** Bytes before a run. */
  std::uint64_t
  GetRunOffset(std::uint64_t run) const;

  /** Reads the box from the segments of a volume, with one request per run and file. Requests of 64 KiB and more skip
   * holes of a file where the system reports them.
   * \throw std::runtime_error with the name of the file and the offset when it cannot be opened or ends early */
  void
  Read(const std::vector<MedialVoxelFileSegment> & segments, void * buffer) const;

  /** Writes the box into the segment of an existing file.
   * \throw std::runtime_error with the name of the file and the offset when any byte cannot be written */
  void
  Write(const MedialVoxelFileSegment & segment, const void * buffer) const;

private:
  std::vector<std::uint64_t> m_Counts;  // number of runs along each axis
  std::vector<std::uint64_t> m_Strides; // bytes from one run to the next along each axis
  std::uint64_t              m_Start{ 0 };
  std::uint64_t              m_BytesPerRun{ 0 };
};

/** Product of the factors, or 0 when one of them is 0 or when the product is no valid file offset. */
MedialVoxel_EXPORT std::uint64_t
                   CheckedFileSize(const std::vector<std::uint64_t> & factors);

/** Creates a file, or replaces it, and gives it a size.
 * \param reserve true: allocate the space on the disk at once, where the file system can; false: the file is one hole
 * \throw std::runtime_error with the name of the file, the size and the reason; the file is removed */
MedialVoxel_EXPORT void
CreateFileOfSize(const std::filesystem::path & fileName, std::uint64_t numberOfBytes, bool reserve);

/** Reverses the bytes of every component of 2, 4 or 8 bytes; others stay as they are. */
MedialVoxel_EXPORT void
SwapComponentBytes(void * buffer, std::uint64_t numberOfBytes, unsigned int bytesPerComponent);

MedialVoxel_EXPORT bool
MachineIsBigEndian();

} // end namespace itk

#endif
