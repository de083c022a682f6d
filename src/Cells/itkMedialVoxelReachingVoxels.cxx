// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelReachingVoxels.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <cmath>

namespace itk
{

namespace
{

using WordType = MedialVoxelBits::WordType;

/** How far an index is from a range. */
std::int64_t
OffsetFrom(const std::int64_t lower, const std::int64_t upper, const std::int64_t index)
{
  return std::max({ lower - index, index - (upper - 1), std::int64_t{ 0 } });
}

/** The bits of a word whose voxels lie so many columns from a range of columns, or more. */
WordType
ColumnsFrom(const std::int64_t word, const MedialVoxelBox & box, const std::int64_t columns)
{
  return columns == 0 ? ~WordType{ 0 }
                      : ~MedialVoxelBits::RangeMask(word, box.lower[0] - columns + 1, box.upper[0] + columns - 1);
}

/** Bits of a row or one beside it, a voxel to either side added to each. */
WordType
Widened(const WordType * const row, const std::int64_t word)
{
  constexpr int last = MedialVoxelBits::BitsPerWord - 1;
  return row[word] | (row[word] << 1) | (row[word] >> 1) | (row[word - 1] >> last) | (row[word + 1] << last);
}

/** All object voxels whose neighborhood has a bit. */
void
FindNeighbors(const MedialVoxelBits & object, const MedialVoxelBits & bits, MedialVoxelBits & neighbors)
{
  const MedialVoxelBox & box = bits.GetBox();
  neighbors.Reshape(box);
  const std::int64_t first = bits.GetFirstWord();
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    MedialVoxelPoll();
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const WordType * const from = object.GetRow(y, z) - object.GetFirstWord();
      WordType * const       to = neighbors.GetRow(y, z) - first;
      for (std::int64_t word = first; word < first + bits.GetWordsPerRow(); ++word)
      {
        const WordType asked = from[word] & MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
        WordType       around = bits.GetRow(y, z)[word - first];
        for (std::int64_t nz = z - 1; nz <= z + 1 && (asked & ~around) != 0; ++nz)
        {
          for (std::int64_t ny = y - 1; ny <= y + 1; ++ny)
          {
            around |= bits.HasRow(ny, nz) ? Widened(bits.GetRow(ny, nz) - first, word) : 0;
          }
        }
        to[word] = asked & around;
      }
    }
  }
}

} // namespace

/** Tests rows of voxels around the corners of cells. */
class MedialVoxelReachingVoxels::Search
{
public:
  Search(const MedialVoxelReachingVoxels & owner, const MedialVoxelBits & object, const MedialVoxelBox & corners)
    : m_Owner(owner)
    , m_Object(object)
    , m_Corners(corners)
  {}

  /** Go to a row; the steps of one depend on its offset alone. */
  void
  SetRow(const std::int64_t y, const std::int64_t z)
  {
    m_Y = y;
    m_Z = z;
    const std::int64_t offsetY = OffsetFrom(m_Corners.lower[1], m_Corners.upper[1], y);
    const std::int64_t offsetZ = OffsetFrom(m_Corners.lower[2], m_Corners.upper[2], z);
    if (offsetY != m_OffsetY || offsetZ != m_OffsetZ)
    {
      m_OffsetY = offsetY;
      m_OffsetZ = offsetZ;
      for (std::size_t i = 0; i < FirstColumns.size(); ++i)
      {
        m_Steps[i] = m_Owner.GetSteps({ { FirstColumns[i], offsetY, offsetZ } });
      }
    }
  }

  /** Those of a word of object voxels that lie deep enough. */
  WordType
  FindIn(const std::int64_t word, WordType voxels) const
  {
    WordType reaching = 0;
    // Most words are not beside the cells.
    const std::int64_t first = word * MedialVoxelBits::BitsPerWord;
    if (first >= m_Corners.lower[0] && first + MedialVoxelBits::BitsPerWord <= m_Corners.upper[0])
    {
      return this->FindDeep(word, voxels, m_Steps[0]);
    }
    for (std::size_t i = FirstColumns.size(); i-- > 0 && voxels != 0;)
    {
      const WordType columns = voxels & ColumnsFrom(word, m_Corners, FirstColumns[i]);
      voxels &= ~columns;
      reaching |= this->FindDeep(word, columns, m_Steps[i]);
    }
    return reaching;
  }

private:
  /** Bits whose voxels so many steps away along x are object or not known. */
  WordType
  AlongX(const WordType * const row, const std::int64_t word, const std::int64_t steps) const
  {
    const std::int64_t left = MedialVoxelBits::BitsPerWord - steps;
    const auto         range = [&](const std::int64_t way) {
      return MedialVoxelBits::RangeMask(word, m_Object.GetBox().lower[0] + way, m_Object.GetBox().upper[0] + way);
    };
    const WordType upwards = (row[word] >> steps) | (row[word + 1] << left) | ~range(-steps);
    const WordType downwards = (row[word] << steps) | (row[word - 1] >> left) | ~range(steps);
    return upwards & downwards;
  }

  WordType
  RowAt(const std::int64_t word, const std::int64_t y, const std::int64_t z) const
  {
    return m_Object.HasRow(y, z) ? m_Object.GetRow(y, z)[word - m_Object.GetFirstWord()] : ~WordType{ 0 };
  }

  WordType
  FindDeep(const std::int64_t word, WordType voxels, const MedialVoxelIndex & steps) const
  {
    if (voxels != 0 && steps[1] > 0)
    {
      voxels &= this->RowAt(word, m_Y - steps[1], m_Z) & this->RowAt(word, m_Y + steps[1], m_Z);
    }
    if (voxels != 0 && steps[2] > 0)
    {
      voxels &= this->RowAt(word, m_Y, m_Z - steps[2]) & this->RowAt(word, m_Y, m_Z + steps[2]);
    }
    if (voxels != 0 && steps[0] > 0)
    {
      voxels &= this->AlongX(m_Object.GetRow(m_Y, m_Z) - m_Object.GetFirstWord(), word, steps[0]);
    }
    return voxels;
  }

  const MedialVoxelReachingVoxels &                 m_Owner;
  const MedialVoxelBits &                           m_Object;
  MedialVoxelBox                                    m_Corners;
  std::int64_t                                      m_Y{ 0 };
  std::int64_t                                      m_Z{ 0 };
  std::int64_t                                      m_OffsetY{ -1 };
  std::int64_t                                      m_OffsetZ{ -1 };
  std::array<MedialVoxelIndex, FirstColumns.size()> m_Steps{};
};

MedialVoxelReachingVoxels::MedialVoxelReachingVoxels(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{
  const MedialVoxelIndex diagonal = grid.GetUnitMargin();
  m_HalfDiagonal = 0.5 * std::sqrt(grid.SquaredMetricLength(diagonal[0], diagonal[1], diagonal[2]));
}

MedialVoxelIndex
MedialVoxelReachingVoxels::GetSteps(const MedialVoxelIndex & offset) const
{
  double way = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    way = std::max(way, static_cast<double>(offset[axis]) * m_Grid.GetMetricSpacing()[axis]);
  }
  // Shifts are less than a word; a test of fewer steps is as right, and leaves out less.
  constexpr double most = MedialVoxelBits::BitsPerWord - 1;
  const double     depth = (way - m_HalfDiagonal) * (1.0 - MedialVoxelResolutionBand);
  MedialVoxelIndex steps{ { 0, 0, 0 } };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (depth > 0.0 && m_Grid.IsActive(axis))
    {
      const double longest = std::min(std::ceil(depth / m_Grid.GetMetricSpacing()[axis]) - 1.0, most);
      steps[axis] = static_cast<std::int64_t>(longest);
    }
  }
  return steps;
}

void
MedialVoxelReachingVoxels::Find(const MedialVoxelBits & object,
                                const MedialVoxelBox &  cells,
                                const MedialVoxelBox &  voxels,
                                Workspace &             workspace) const
{
  MedialVoxelBits & reaching = workspace.reaching;
  reaching.Reshape(voxels);
  MedialVoxelBox corners = cells;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    corners.upper[axis] += m_Grid.GetUnitMargin()[axis];
  }
  Search             search(*this, object, corners);
  const std::int64_t first = reaching.GetFirstWord();
  for (std::int64_t z = voxels.lower[2]; z < voxels.upper[2]; ++z)
  {
    MedialVoxelPoll();
    for (std::int64_t y = voxels.lower[1]; y < voxels.upper[1]; ++y)
    {
      const WordType * const from = object.GetRow(y, z) - object.GetFirstWord();
      WordType * const       to = reaching.GetRow(y, z) - first;
      search.SetRow(y, z);
      for (std::int64_t word = first; word < first + reaching.GetWordsPerRow(); ++word)
      {
        const WordType bits = from[word] & MedialVoxelBits::RangeMask(word, voxels.lower[0], voxels.upper[0]);
        to[word] = bits == 0 ? 0 : search.FindIn(word, bits);
      }
    }
  }
  FindNeighbors(object, reaching, workspace.asked);
}

} // end namespace itk
