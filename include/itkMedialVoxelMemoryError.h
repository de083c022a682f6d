// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelMemoryError_h
#define itkMedialVoxelMemoryError_h

#include "itkMedialVoxelMemoryShortage.h"

#include "itkMacro.h"

#include <stdexcept>

namespace itk
{

/** \class MedialVoxelMemoryError
 * \brief A single voxel of the image depends on more voxels than the working memory limit of a filter can hold.
 * \ingroup MedialVoxel
 */
class MedialVoxelMemoryError : public MemoryAllocationError
{
public:
  explicit MedialVoxelMemoryError(const MedialVoxelMemoryShortage & shortage)
    : MemoryAllocationError(__FILE__, __LINE__, shortage.what(), ITK_LOCATION)
    , m_NeededBytes(shortage.GetNeededBytes())
    , m_AllowedBytes(shortage.GetAllowedBytes())
  {}

  const char *
  GetNameOfClass() const override
  {
    return "MedialVoxelMemoryError";
  }

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

/** Calls a function of the library below the filters. Hosts of ITK catch only exceptions of ITK, so exceptions of the
 * library become exceptions of ITK. Exceptions of observers pass unchanged. */
template <typename TFunction>
decltype(auto)
MedialVoxelWithItkErrors(TFunction && function)
{
  try
  {
    return function();
  }
  catch (const MedialVoxelMemoryShortage & shortage)
  {
    throw MedialVoxelMemoryError(shortage);
  }
  catch (const std::length_error & error)
  {
    throw ExceptionObject(__FILE__, __LINE__, error.what(), ITK_LOCATION);
  }
}

} // end namespace itk

#endif
