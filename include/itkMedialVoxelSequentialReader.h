// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSequentialReader_h
#define itkMedialVoxelSequentialReader_h

#include "itkMedialVoxelFileRegion.h"

namespace itk
{

/** \class MedialVoxelSequentialReader
 * \brief Reads boxes of a volume, and has the disk read ahead while the caller works.
 *
 * When a box is one run of bytes that begins where the one before ended, or at the first voxel, the system is asked to
 * read as many bytes after it into its cache, without waiting and without holes. A pipeline that pulls slab after slab
 * then finds the next one there. For boxes in any other order there is no reading ahead.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSequentialReader
{
public:
  /** Reads a box like MedialVoxelFileRegion::Read(), with its exceptions. */
  void
  Read(const MedialVoxelFileRegion & region, const std::vector<MedialVoxelFileSegment> & segments, void * buffer);

  /** Bytes handed out so far, including holes. */
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
