// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClosedPores.h"

#include <algorithm>
#include <utility>

namespace itk
{

MedialVoxelClosedPores::MedialVoxelClosedPores(const MedialVoxelGrid & grid, const std::uint64_t maximumSize)
  : m_Image(grid.GetVoxelBox())
  , m_MaximumSize(maximumSize)
{}

void
MedialVoxelClosedPores::AddSlice(MedialVoxelBits object)
{
  m_Slices.push_back(std::move(object));
  ++m_NumberOfSlices;
  const auto isReady = [this](const std::int64_t slice) {
    return slice < m_NumberOfSlices && (m_NumberOfSlices == m_Image.upper[2] ||
                                        static_cast<std::uint64_t>(m_NumberOfSlices - 1 - slice) >= m_MaximumSize);
  };
  for (; isReady(m_NumberDone); ++m_NumberDone)
  {
    if (m_MaximumSize > 0)
    {
      this->FillFrom(m_NumberDone);
      m_Below = this->At(m_NumberDone);
    }
  }
}

MedialVoxelBits
MedialVoxelClosedPores::TakeSlice()
{
  MedialVoxelBits slice = std::move(m_Slices.front());
  m_Slices.pop_front();
  ++m_FirstSlice;
  return slice;
}

bool
MedialVoxelClosedPores::IsAtFace(const MedialVoxelIndex & voxel) const
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (m_Image.upper[axis] > 1 && (voxel[axis] == 0 || voxel[axis] == m_Image.upper[axis] - 1))
    {
      return true;
    }
  }
  return false;
}

void
MedialVoxelClosedPores::Invert(const MedialVoxelIndex & voxel)
{
  MedialVoxelBits & slice = m_Slices[static_cast<std::size_t>(voxel[2] - m_FirstSlice)];
  slice.GetRow(voxel[1], voxel[2])[voxel[0] >> 6] ^= MedialVoxelBits::WordType{ 1 } << (voxel[0] & 63);
}

/** The first voxel of a component in the order z, y, x follows object along each axis. It is at no face. */
void
MedialVoxelClosedPores::FillFrom(const std::int64_t slice)
{
  using WordType = MedialVoxelBits::WordType;
  const bool hasSlices = m_Image.upper[2] > 1;
  const bool hasRows = m_Image.upper[1] > 1;
  if (hasSlices && (slice == 0 || slice == m_Image.upper[2] - 1))
  {
    return;
  }
  const std::int64_t margin = hasRows ? 1 : 0;
  for (std::int64_t y = margin; y < m_Image.upper[1] - margin; ++y)
  {
    const WordType * const own = this->At(slice).GetRow(y, slice);
    const WordType * const before = hasRows ? this->At(slice).GetRow(y - 1, slice) : nullptr;
    const WordType * const below = hasSlices ? m_Below.GetRow(y, slice - 1) : nullptr;
    for (std::int64_t word = 0; word < this->At(slice).GetWordsPerRow(); ++word)
    {
      WordType seeds = ~own[word] & MedialVoxelBits::RangeMask(word, 0, m_Image.upper[0]);
      seeds &= m_Image.upper[0] > 1 ? (own[word] << 1) | (own[word - 1] >> 63) : ~WordType{ 0 };
      seeds &= before != nullptr ? before[word] : ~WordType{ 0 };
      seeds &= below != nullptr ? below[word] : ~WordType{ 0 };
      for (; seeds != 0; seeds &= seeds - 1)
      {
        this->FillIfSmall({ { word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(seeds), y, slice } });
      }
    }
  }
}

void
MedialVoxelClosedPores::FillIfSmall(const MedialVoxelIndex & seed)
{
  if (this->IsBackground(seed) && !this->InvertComponent(seed))
  {
    for (const MedialVoxelIndex & voxel : m_Component)
    {
      this->Invert(voxel);
    }
  }
}

/** Collect the component and invert it; false as soon as it is too large, reaches a face or begins before the slice of
 * the seed. */
bool
MedialVoxelClosedPores::InvertComponent(const MedialVoxelIndex & seed)
{
  m_Component.assign(1, seed);
  this->Invert(seed);
  for (std::size_t i = 0; i < m_Component.size(); ++i)
  {
    const MedialVoxelIndex voxel = m_Component[i];
    if (this->IsAtFace(voxel))
    {
      return false;
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (int step = -1; step <= 1 && m_Image.upper[axis] > 1; step += 2)
      {
        MedialVoxelIndex neighbor = voxel;
        neighbor[axis] += step;
        if (neighbor[2] < seed[2])
        {
          if (!m_Below.Test(neighbor))
          {
            return false;
          }
        }
        else if (this->IsBackground(neighbor))
        {
          if (m_Component.size() == m_MaximumSize)
          {
            return false;
          }
          m_Component.push_back(neighbor);
          this->Invert(neighbor);
        }
      }
    }
  }
  return true;
}

} // end namespace itk
