// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelOpenVoxels.h"

#include <algorithm>

namespace itk
{
namespace
{

std::int64_t
DivideUp(const std::int64_t number, const std::int64_t by)
{
  return (number + by - 1) / by;
}

} // namespace

void
MedialVoxelOpenVoxels::Open(const MedialVoxelBox & box, const MedialVoxelBits & object, std::vector<float> & values)
{
  m_Box = box;
  m_Words = DivideUp(box.Extent(0), MedialVoxelBits::BitsPerWord);
  m_Bricks = DivideUp(box.Extent(1), BrickSize);
  values.assign(static_cast<std::size_t>(box.NumberOfVoxels()), 0.0f);
  m_Values = values.data();
  m_Open.assign(static_cast<std::size_t>(m_Words * box.Extent(1) * box.Extent(2)), 0);
  m_OpenLines.assign(static_cast<std::size_t>(m_Words * m_Bricks * DivideUp(box.Extent(2), BrickSize)), {});
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      std::uint64_t * const open = m_Open.data() + this->GetPlaceOfRow(y, z);
      for (std::int64_t word = 0; word < m_Words; ++word)
      {
        const std::int64_t x = box.lower[0] + word * MedialVoxelBits::BitsPerWord;
        open[word] = object.Extract(x, y, z) & MedialVoxelBits::RangeMask(0, 0, box.upper[0] - x);
        if (open[word] != 0)
        {
          OpenLines & lines = m_OpenLines[this->GetPlaceOfBrick(this->GetBrickOf({ { x, y, z } }))];
          lines.rows |= this->GetBitOfRow(y, z);
          lines.columns |= open[word];
        }
      }
    }
  }
}

bool
MedialVoxelOpenVoxels::IsDone() const
{
  return std::all_of(m_OpenLines.begin(), m_OpenLines.end(), [](const OpenLines & open) { return open.rows == 0; });
}

void
MedialVoxelOpenVoxels::CloseRest(const float value)
{
  this->CloseBall(
    m_Box, value, [this](std::int64_t, std::int64_t) { return RowRange{ m_Box.lower[0], m_Box.upper[0] }; });
}

void
MedialVoxelOpenVoxels::CloseRow(const std::int64_t y, const std::int64_t z, const std::int64_t word)
{
  const MedialVoxelIndex brick = this->GetBrickOf({ { m_Box.lower[0], y, z } });
  m_OpenLines[this->GetPlaceOfBrick({ { word, brick[1], brick[2] } })].rows &= ~this->GetBitOfRow(y, z);
}

void
MedialVoxelOpenVoxels::FindColumns(const MedialVoxelIndex & brick, OpenLines & open) const
{
  const MedialVoxelIndex first = this->GetFirstVoxel(brick);
  open.columns = 0;
  for (std::uint64_t rows = open.rows; rows != 0; rows &= rows - 1)
  {
    const int row = MedialVoxelLowestBit(rows);
    open.columns |= m_Open[this->GetPlaceOfRow(first[1] + row % BrickSize, first[2] + row / BrickSize) +
                           static_cast<std::size_t>(brick[0])];
  }
}

void
MedialVoxelOpenVoxels::SetValues(const std::int64_t y,
                                 const std::int64_t z,
                                 const std::int64_t word,
                                 std::uint64_t      bits,
                                 const float        value)
{
  float * const row = m_Values + m_Box.OffsetOf({ { m_Box.lower[0], y, z } }) + word * MedialVoxelBits::BitsPerWord;
  for (; bits != 0; bits &= bits - 1)
  {
    row[MedialVoxelLowestBit(bits)] = value;
  }
}

} // end namespace itk
