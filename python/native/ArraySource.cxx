// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArraySource.h"

namespace medialvoxel
{

itk::MedialVoxelValueType
ArraySource::GetValueType() const
{
  return m_Call.header.pixelType;
}

itk::MedialVoxelSourceThreads
ArraySource::GetSourceThreads() const
{
  return itk::MedialVoxelSourceThreads::Several;
}

void
ArraySource::WithBox(const itk::MedialVoxelBox & box, const ViewFunction & function)
{
  const std::int64_t * const    size = m_Call.array.size;
  const itk::MedialVoxelStrides strides{ { 1, size[0], size[0] * size[1] } };
  const std::int64_t            offset = box.lower[0] + strides[1] * box.lower[1] + strides[2] * box.lower[2];
  const std::size_t             bytes = GetTraits(m_Call.header.pixelType).bytes;
  function({ static_cast<const std::byte *>(m_Call.array.values) + static_cast<std::size_t>(offset) * bytes, strides });
}

} // end namespace medialvoxel
