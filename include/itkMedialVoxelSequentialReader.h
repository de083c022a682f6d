// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSequentialReader_h
#define itkMedialVoxelSequentialReader_h

#include "itkMedialVoxelFileRegion.h"

namespace itk
{

/** \class MedialVoxelSequentialReader
 * \brief Reads boxes of a volume; asks the disk for what follows while the caller works on what it has.
 *
 * When a box is one run of bytes that begins where the one before ended, or at the first voxel, the system is asked to
 * bring as many bytes after it into its cache, without waiting for them, and without those in holes. A pipeline that
 * pulls slab after slab then finds the next one there. Boxes in any other order are read as they are.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSequentialReader
{
public:
  /** Reads a box like MedialVoxelFileRegion::Read(), with its exceptions. */
  void
  Read(const MedialVoxelFileRegion & region, const std::vector<MedialVoxelFileSegment> & segments, void * buffer);

  /** Bytes handed out so far; those of holes count. */
  std::uint64_t
  GetNumberOfBytesRead() const
  {
    return m_NumberOfBytesRead;
  }

private:
  std::uint64_t m_NumberOfBytesRead{ 0 };
  std::uint64_t m_End{ 0 };
};

} // end namespace itk

#endif
