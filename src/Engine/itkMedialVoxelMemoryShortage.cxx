// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelMemoryShortage.h"

#include <string>

namespace itk
{

MedialVoxelMemoryShortage::MedialVoxelMemoryShortage(const std::uint64_t neededBytes, const std::uint64_t allowedBytes)
  : std::runtime_error("The walls are so thick that the windows on the input need at least " +
                       std::to_string(neededBytes) + " bytes of memory; " + std::to_string(allowedBytes) +
                       " bytes are allowed.")
  , m_NeededBytes(neededBytes)
  , m_AllowedBytes(allowedBytes)
{}

} // end namespace itk
