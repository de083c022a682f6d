// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelReachingVoxels.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

/** From the first to the last bit of a row. */
class WordExtent
{
public:
  /** Words in ascending order. */
  void
  Add(const std::int64_t word, const WordType bits)
  {
    if (bits != 0)
    {
      const std::int64_t first = word * MedialVoxelBits::BitsPerWord;
      m_Lower = m_Upper == 0 ? first + MedialVoxelLowestBit(bits) : m_Lower;
      m_Upper = first + MedialVoxelHighestBit(bits) + 1;
    }
  }

  MedialVoxelBox
  GetRow(const std::int64_t y, const std::int64_t z) const
  {
    return m_Upper == 0 ? MedialVoxelBox{} : MedialVoxelBox{ { { m_Lower, y, z } }, { { m_Upper, y + 1, z + 1 } } };
  }

private:
  std::int64_t m_Lower{ 0 };
  std::int64_t m_Upper{ 0 };
};

/** Bits of a row or one beside it, a voxel to either side added to each. */
WordType
Widened(const WordType * const row, const std::int64_t word)
{
  constexpr int last = MedialVoxelBits::BitsPerWord - 1;
  return row[word] | (row[word] << 1) | (row[word] >> 1) | (row[word - 1] >> last) | (row[word + 1] << last);
}

/** All object voxels of \a box whose neighborhood has a bit. */
void
FindNeighbors(const MedialVoxelBits & object,
              const MedialVoxelBits & bits,
              const MedialVoxelBox &  box,
              MedialVoxelBits &       neighbors)
{
  neighbors.Reshape(bits.GetBox());
  const std::int64_t first = bits.GetFirstWord();
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    MedialVoxelCheckAbort();
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const WordType * const from = object.GetRow(y, z) - object.GetFirstWord();
      WordType * const       to = neighbors.GetRow(y, z) - first;
      for (std::int64_t word = box.lower[0] >> 6; word <= (box.upper[0] - 1) >> 6; ++word)
      {
        if (from[word] == 0)
        {
          continue;
        }
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
  Search(const MedialVoxelReachingVoxels & owner,
         const MedialVoxelBits &           object,
         const MedialVoxelBox &            corners,
         const MedialVoxelBits &           reaching)
    : m_Object(object)
    , m_Corners(corners)
    , m_FirstWord(reaching.GetFirstWord())
  {
    const MedialVoxelBox & box = reaching.GetBox();
    for (std::int64_t word = m_FirstWord; word < m_FirstWord + reaching.GetWordsPerRow(); ++word)
    {
      Columns  columns{};
      WordType rest = MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
      for (std::size_t i = columns.size(); i-- > 0;)
      {
        columns[i] = rest & ColumnsFrom(word, m_Corners, FirstColumns[i]);
        rest &= ~columns[i];
      }
      m_Columns.push_back(columns);
    }
    const MedialVoxelGrid & grid = owner.m_Grid;
    for (const std::int64_t column : FirstColumns)
    {
      m_StepsAlong[0].push_back(owner.GetSteps(static_cast<double>(column) * grid.GetMetricSpacing()[0]));
    }
    for (unsigned int axis = 1; axis < 3; ++axis)
    {
      const std::int64_t most =
        std::max(m_Corners.lower[axis] - box.lower[axis], box.upper[axis] - m_Corners.upper[axis]);
      for (std::int64_t offset = 0; offset <= std::max<std::int64_t>(most, 0); ++offset)
      {
        m_StepsAlong[axis].push_back(owner.GetSteps(static_cast<double>(offset) * grid.GetMetricSpacing()[axis]));
      }
    }
  }

  /** Go to a row. */
  void
  SetRow(const std::int64_t y, const std::int64_t z)
  {
    m_Y = y;
    m_Z = z;
    const auto & along = m_StepsAlong;
    const auto & stepsY = along[1][static_cast<std::size_t>(OffsetFrom(m_Corners.lower[1], m_Corners.upper[1], y))];
    const auto & stepsZ = along[2][static_cast<std::size_t>(OffsetFrom(m_Corners.lower[2], m_Corners.upper[2], z))];
    for (std::size_t i = 0; i < FirstColumns.size(); ++i)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        m_Steps[i][axis] = std::max({ along[0][i][axis], stepsY[axis], stepsZ[axis] });
      }
    }
  }

  /** The object voxels of a word that lie deep enough. */
  WordType
  FindIn(const std::int64_t word, const WordType object) const
  {
    const Columns & columns = m_Columns[static_cast<std::size_t>(word - m_FirstWord)];
    WordType        reaching = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      const WordType voxels = object & columns[i];
      reaching |= voxels == 0 ? 0 : this->FindDeep(word, voxels, m_Steps[i]);
    }
    return reaching;
  }

private:
  /** The bits of a word in each range of columns. */
  using Columns = std::array<WordType, FirstColumns.size()>;

  /** Bits whose voxels so many steps away along x are object or not known. */
  WordType
  AlongX(const WordType * const row, const std::int64_t word, const std::int64_t steps) const
  {
    const std::int64_t left = MedialVoxelBits::BitsPerWord - steps;
    const auto         range = [&](const std::int64_t offset) {
      return MedialVoxelBits::RangeMask(word, m_Object.GetBox().lower[0] + offset, m_Object.GetBox().upper[0] + offset);
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
    if (steps[1] > 0)
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

  const MedialVoxelBits &                           m_Object;
  MedialVoxelBox                                    m_Corners;
  std::int64_t                                      m_FirstWord;
  std::vector<Columns>                              m_Columns; // of each word of a row
  std::int64_t                                      m_Y{ 0 };
  std::int64_t                                      m_Z{ 0 };
  std::array<std::vector<MedialVoxelIndex>, 3>      m_StepsAlong; // of ranges of columns, and of rows by their offset
  std::array<MedialVoxelIndex, FirstColumns.size()> m_Steps{};
};

MedialVoxelReachingVoxels::MedialVoxelReachingVoxels(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{
  const MedialVoxelIndex diagonal = grid.GetUnitMargin();
  m_HalfDiagonal = 0.5 * std::sqrt(grid.SquaredMetricLength(diagonal[0], diagonal[1], diagonal[2]));
}

MedialVoxelIndex
MedialVoxelReachingVoxels::GetSteps(const double distance) const
{
  // Shifts are less than a word; a test of fewer steps is correct, and keeps more voxels.
  constexpr double most = MedialVoxelBits::BitsPerWord - 1;
  const double     depth = (distance - m_HalfDiagonal) * (1.0 - MedialVoxelResolutionBand);
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
  Search             search(*this, object, corners, reaching);
  const std::int64_t first = reaching.GetFirstWord();
  MedialVoxelBox     found;
  for (std::int64_t z = voxels.lower[2]; z < voxels.upper[2]; ++z)
  {
    MedialVoxelCheckAbort();
    for (std::int64_t y = voxels.lower[1]; y < voxels.upper[1]; ++y)
    {
      const WordType * const from = object.GetRow(y, z) - object.GetFirstWord();
      WordType * const       to = reaching.GetRow(y, z) - first;
      search.SetRow(y, z);
      WordExtent extent;
      for (std::int64_t word = first; word < first + reaching.GetWordsPerRow(); ++word)
      {
        if (from[word] != 0)
        {
          to[word] = search.FindIn(word, from[word]);
          extent.Add(word, to[word]);
        }
      }
      found = found.Union(extent.GetRow(y, z));
    }
  }
  if (!found.IsEmpty())
  {
    found = found.Expanded(m_Grid.GetUnitMargin());
  }
  workspace.box = found.Union(corners).Intersection(voxels);
  FindNeighbors(object, reaching, workspace.box, workspace.asked);
}

} // end namespace itk
