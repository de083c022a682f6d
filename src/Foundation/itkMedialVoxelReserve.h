// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelReserve_h
#define itkMedialVoxelReserve_h

#include <cstddef>
#include <cstdint>

namespace itk
{

/** Grow without giving memory back, as a workspace serves many tiles; the old values are lost. */
template <typename TVector>
void
MedialVoxelReserve(TVector & values, const std::int64_t size)
{
  if (values.size() < static_cast<std::size_t>(size))
  {
    // Freed first, and not resized, which could take twice as much.
    TVector().swap(values);
    TVector(static_cast<std::size_t>(size)).swap(values);
  }
}

} // end namespace itk

#endif
