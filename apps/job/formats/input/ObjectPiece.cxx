// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectPiece.h"

#include <algorithm>

namespace medialvoxel
{
ObjectPiece::ObjectPiece(itk::MedialVoxelObjectMap & map,
                         const VolumeGeometry &      geometry,
                         std::uint64_t               maximumPoreSize)
  : MedialVoxelObjectRegion(map, geometry.GetVoxelBox().upper, maximumPoreSize)
  , m_Image(geometry.GetVoxelBox())
  , m_LastAxis(geometry.GetDimension() - 1)
  , m_VoxelsPerSlice(geometry.GetVoxelsPerSlice())
{}

void
ObjectPiece::Read(std::uint64_t firstSlice, std::uint64_t endSlice)
{
  itk::MedialVoxelBox slices = m_Image;
  slices.lower[m_LastAxis] = static_cast<std::int64_t>(firstSlice);
  slices.upper[m_LastAxis] = static_cast<std::int64_t>(endSlice);
  this->MedialVoxelObjectRegion::Read(slices);
  m_FirstVoxel = firstSlice * m_VoxelsPerSlice;
}

ObjectNumber
ObjectPiece::FindObjectOfPore(std::uint64_t voxel, unsigned int pass) const
{
  const auto x = static_cast<std::int64_t>(voxel);
  const auto y = x / m_Image.Extent(0);
  return this->FindObjectOfPore({ { x % m_Image.Extent(0), y % m_Image.Extent(1), y / m_Image.Extent(1) } }, pass);
}

} // end namespace medialvoxel
