// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGray.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <utility>

namespace itk
{

std::uint64_t
MedialVoxelGray::GetBytes(const MedialVoxelBox & box)
{
  return static_cast<std::uint64_t>(box.NumberOfVoxels()) * sizeof(float);
}

bool
MedialVoxelGray::IsInPlace(const MedialVoxelBox & box) const
{
  for (unsigned int axis = 0; axis < 2; ++axis)
  {
    if (box.lower[axis] != m_Box.lower[axis] || box.upper[axis] != m_Box.upper[axis])
    {
      return false;
    }
  }
  return static_cast<std::uint64_t>(box.NumberOfVoxels()) <= m_Values.size();
}

std::uint64_t
MedialVoxelGray::GetBytesToReframe(const MedialVoxelBox & box, const MedialVoxelBox & room) const
{
  const std::uint64_t old = m_Values.size() * sizeof(float);
  return this->IsInPlace(box) ? old : old + std::max(GetBytes(box), GetBytes(room));
}

void
MedialVoxelGray::Reframe(const MedialVoxelBox & box, const MedialVoxelBox & room)
{
  const MedialVoxelBox shared = box.Intersection(m_Box);
  if (this->IsInPlace(box))
  {
    if (!shared.IsEmpty())
    {
      const float * const from = this->GetRow(m_Box.lower[1], shared.lower[2]);
      const float * const end = from + shared.Extent(2) * m_Box.Extent(1) * m_Box.Extent(0);
      m_Box = box;
      float * const to = this->GetRow(m_Box.lower[1], shared.lower[2]);
      if (to < from)
      {
        std::copy(from, end, to);
      }
      else
      {
        std::copy_backward(from, end, to + (end - from));
      }
    }
    m_Box = box;
    return;
  }
  MedialVoxelGray moved;
  moved.m_Box = box;
  moved.m_Values.resize(static_cast<std::size_t>(std::max(box.NumberOfVoxels(), room.NumberOfVoxels())));
  for (std::int64_t z = shared.lower[2]; z < shared.upper[2]; ++z)
  {
    MedialVoxelPoll();
    for (std::int64_t y = shared.lower[1]; y < shared.upper[1] && !shared.IsEmpty(); ++y)
    {
      const float * const row = this->GetRow(y, z) + (shared.lower[0] - m_Box.lower[0]);
      std::copy(row, row + shared.Extent(0), moved.GetRow(y, z) + (shared.lower[0] - box.lower[0]));
    }
  }
  *this = std::move(moved);
}

} // end namespace itk
