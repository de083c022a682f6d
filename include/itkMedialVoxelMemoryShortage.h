// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelMemoryError_h
#define itkMedialVoxelMemoryError_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <stdexcept>

namespace itk
{

/** \class MedialVoxelMemoryError
 * \brief The memory that an engine may use does not hold what a single voxel of the image depends on.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelMemoryError : public std::runtime_error
{
public:
  MedialVoxelMemoryError(std::uint64_t neededBytes, std::uint64_t allowedBytes);

  /** Bytes that the step at hand needs; later ones may need more. */
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
