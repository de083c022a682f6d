// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGray.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cstring>
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
  return static_cast<std::uint64_t>(box.NumberOfVoxels()) <= m_NumberOfValues;
}

std::uint64_t
MedialVoxelGray::GetBytesToReframe(const MedialVoxelBox & box, const MedialVoxelBox & largestBox) const
{
  const std::uint64_t old = this->GetReservedBytes();
  return this->IsInPlace(box) ? old : old + std::max(GetBytes(box), GetBytes(largestBox));
}

void
MedialVoxelGray::Reframe(const MedialVoxelBox & box, const MedialVoxelBox & largestBox)
{
  const MedialVoxelBox shared = box.Intersection(m_Box);
  if (this->IsInPlace(box))
  {
    if (!shared.IsEmpty())
    {
      const float * const from = this->GetRow(m_Box.lower[1], shared.lower[2]);
      const auto          values = static_cast<std::size_t>(shared.Extent(2) * m_Box.Extent(1) * m_Box.Extent(0));
      m_Box = box;
      std::memmove(this->GetRow(m_Box.lower[1], shared.lower[2]), from, values * sizeof(float));
    }
    m_Box = box;
    return;
  }
  MedialVoxelGray moved;
  moved.Frame(box, largestBox);
  for (MedialVoxelBox slice = shared; slice.lower[2] < shared.upper[2]; ++slice.lower[2])
  {
    MedialVoxelCheckAbort();
    slice.upper[2] = slice.lower[2] + 1;
    moved.CopyRows(*this, slice);
  }
  *this = std::move(moved);
}

std::uint64_t
MedialVoxelGray::GetBytesToFrame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox) const
{
  return GetBytes(box) <= this->GetReservedBytes() ? this->GetReservedBytes()
                                                   : std::max(GetBytes(box), GetBytes(largestBox));
}

void
MedialVoxelGray::Frame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox)
{
  const std::uint64_t bytes = this->GetBytesToFrame(box, largestBox);
  if (bytes != this->GetReservedBytes())
  {
    // Free the old memory first, so that both never exist at the same time.
    *this = {};
    m_Values.reset(new float[static_cast<std::size_t>(bytes / sizeof(float))]);
    m_NumberOfValues = static_cast<std::size_t>(bytes / sizeof(float));
  }
  m_Box = box;
}

void
MedialVoxelGray::CopyRows(const MedialVoxelGray & source, const MedialVoxelBox & rows)
{
  const MedialVoxelBox shared = rows.Intersection(m_Box).Intersection(source.m_Box);
  for (std::int64_t z = shared.lower[2]; z < shared.upper[2]; ++z)
  {
    for (std::int64_t y = shared.lower[1]; y < shared.upper[1]; ++y)
    {
      const float * const row = source.m_Values.get() + source.OffsetOf(shared.lower[0], y, z);
      std::copy(row, row + shared.Extent(0), m_Values.get() + this->OffsetOf(shared.lower[0], y, z));
    }
  }
}

} // end namespace itk
