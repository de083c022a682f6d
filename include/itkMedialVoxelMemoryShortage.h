// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelMemoryShortage_h
#define itkMedialVoxelMemoryShortage_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <stdexcept>

namespace itk
{

/** \class MedialVoxelMemoryShortage
 * \brief A single voxel of the image depends on more voxels than the memory limit of an engine can hold.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelMemoryShortage : public std::runtime_error
{
public:
  MedialVoxelMemoryShortage(std::uint64_t neededBytes, std::uint64_t allowedBytes);

  /** Bytes that the current step needs; later ones may need more. */
  std::uint64_t
  GetNeededBytes() const
  {
    return m_NeededBytes;
  }

  std::uint64_t
  GetAllowedBytes() const
  {
    return m_AllowedBytes;
  }

private:
  std::uint64_t m_NeededBytes;
  std::uint64_t m_AllowedBytes;
};

} // end namespace itk

#endif
