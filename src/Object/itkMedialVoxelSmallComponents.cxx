// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSmallComponents.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>
#include <vector>

namespace itk
{
namespace
{

using WordType = MedialVoxelBits::WordType;

/** Index within the bits of a box; axes are at most 2^31 - 1 long. */
struct Voxel
{
  std::int32_t x;
  std::int32_t y;
  std::int32_t z;
};

/** The bits of one kind, object or background, as words; x counts from the first bit of a row. */
class KindBits
{
public:
  KindBits(MedialVoxelBits & object, const bool isObject)
    : m_Words(object.GetRow(object.GetBox().lower[1], object.GetBox().lower[2]))
    , m_Flip(isObject ? 0 : ~WordType{ 0 })
    , m_RowPitch(object.GetRowPitch())
    , m_SlicePitch(object.GetRowPitch() * object.GetBox().Extent(1))
  {}

  /** Number of a bit, in the order z, y, x. */
  std::int64_t
  AddressOf(const std::int64_t x, const std::int64_t y, const std::int64_t z) const
  {
    return (z * m_SlicePitch + y * m_RowPitch) * MedialVoxelBits::BitsPerWord + x;
  }

  bool
  Test(const std::int64_t address) const
  {
    return (((m_Words[address >> 6] ^ m_Flip) >> (address & 63)) & 1u) != 0;
  }

  /** The bits before, at and after an address. */
  WordType
  TestThree(const std::int64_t address) const
  {
    const std::int64_t first = address - 1;
    const auto         shift = static_cast<unsigned int>(first & 63);
    const WordType     upper = shift > 61 ? m_Words[(first >> 6) + 1] << (64 - shift) : 0;
    return (((m_Words[first >> 6] >> shift) | upper) ^ m_Flip) & 7u;
  }

  /** The word of a row, also -1 and the one after the last. */
  WordType
  GetWord(const std::int64_t word, const std::int64_t y, const std::int64_t z) const
  {
    return m_Words[z * m_SlicePitch + y * m_RowPitch + word] ^ m_Flip;
  }

  void
  Invert(const std::int64_t address)
  {
    m_Words[address >> 6] ^= WordType{ 1 } << (address & 63);
  }

private:
  WordType *   m_Words;
  WordType     m_Flip;
  std::int64_t m_RowPitch;
  std::int64_t m_SlicePitch;
};

/** Changes the small components of one kind that begin in a box and meet another one. */
class ComponentChange
{
public:
  ComponentChange(const MedialVoxelGrid & grid,
                  const std::uint64_t     maximumSize,
                  const bool              isObject,
                  MedialVoxelBits &       object,
                  MedialVoxelSparseBits & changed)
    : m_MaximumSize(static_cast<std::size_t>(
        std::min<std::uint64_t>(maximumSize, static_cast<std::uint64_t>(object.GetBox().NumberOfVoxels()))))
    , m_Bits(object, isObject)
    , m_Changed(changed)
    , m_Box(object.GetBox())
    , m_FirstX(object.GetFirstWord() * MedialVoxelBits::BitsPerWord)
    , m_Unit(grid.GetUnitMargin())
  {
    for (std::int64_t dz = -m_Unit[2]; dz <= m_Unit[2]; ++dz)
    {
      for (std::int64_t dy = -m_Unit[1]; dy <= m_Unit[1]; ++dy)
      {
        m_Rows[m_NumberOfRows++] = { static_cast<std::int32_t>(dy),
                                     static_cast<std::int32_t>(dz),
                                     m_Bits.AddressOf(0, dy, dz) };
      }
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t first = axis == 0 ? m_FirstX : m_Box.lower[axis];
      m_Lower[axis] = m_Unit[axis] == 0 ? -1 : m_Box.lower[axis] - first;
      m_Upper[axis] = m_Unit[axis] == 0 ? m_Box.upper[axis] - first : m_Box.upper[axis] - 1 - first;
    }
    m_Component.reserve(m_MaximumSize);
  }

  void
  Run(const MedialVoxelBox & seeds, const MedialVoxelBox & touched)
  {
    // A component at the edge of the bits may be large.
    const MedialVoxelBox inner = this->InnerBox();
    const MedialVoxelBox box = seeds.Intersection(inner);
    for (std::int64_t z = box.lower[2]; z < box.upper[2] && !box.IsEmpty(); ++z)
    {
      MedialVoxelCheckAbort();
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        m_Checker.Count(static_cast<std::uint32_t>(box.Extent(0) / MedialVoxelBits::BitsPerWord + 1));
        this->ChangeFromRow(box, y, z, touched);
      }
    }
  }

private:
  /** A row of neighbors. */
  struct Row
  {
    std::int32_t dy;
    std::int32_t dz;
    std::int64_t offset;
  };

  MedialVoxelBox
  InnerBox() const
  {
    MedialVoxelBox inner = m_Box;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      inner.lower[axis] += m_Unit[axis];
      inner.upper[axis] -= m_Unit[axis];
    }
    return inner;
  }

  /** The first voxel of a component in the order z, y, x has none of its neighbors before it. */
  void
  ChangeFromRow(const MedialVoxelBox & box, const std::int64_t y, const std::int64_t z, const MedialVoxelBox & touched)
  {
    const std::int64_t firstWord = m_FirstX / MedialVoxelBits::BitsPerWord;
    const std::int64_t lastWord = (box.upper[0] - 1) / MedialVoxelBits::BitsPerWord;
    const std::int64_t ownY = y - m_Box.lower[1];
    const std::int64_t ownZ = z - m_Box.lower[2];
    for (std::int64_t word = box.lower[0] / MedialVoxelBits::BitsPerWord; word <= lastWord; ++word)
    {
      const std::int64_t w = word - firstWord;
      // Long runs of one kind have at most one bit left for the look at other rows.
      WordType firsts = m_Bits.GetWord(w, ownY, ownZ) & ~this->BitsAfterOthersInRow(w, ownY, ownZ);
      if (firsts == 0)
      {
        continue;
      }
      firsts = this->KeepFirsts(firsts, w, ownY, ownZ);
      if (firsts == 0)
      {
        continue;
      }
      firsts &= MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
      for (; firsts != 0; firsts &= firsts - 1)
      {
        const auto x = static_cast<std::int32_t>(w * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(firsts));
        this->ChangeIfSmall({ x, static_cast<std::int32_t>(ownY), static_cast<std::int32_t>(ownZ) }, touched);
      }
    }
  }

  /** Bits of a word with a neighbor of their kind before them in the row. */
  WordType
  BitsAfterOthersInRow(const std::int64_t w, const std::int64_t y, const std::int64_t z) const
  {
    return m_Unit[0] == 0 ? 0 : (m_Bits.GetWord(w, y, z) << 1) | (m_Bits.GetWord(w - 1, y, z) >> 63);
  }

  /** Bits of a word without a neighbor of their kind in an earlier row. */
  WordType
  KeepFirsts(WordType bits, const std::int64_t w, const std::int64_t y, const std::int64_t z) const
  {
    const auto rowsBefore = [&](const std::int64_t word) {
      WordType sum = 0;
      for (unsigned int i = 0; i < m_NumberOfRows / 2; ++i)
      {
        sum |= m_Bits.GetWord(word, y + m_Rows[i].dy, z + m_Rows[i].dz);
      }
      return sum;
    };
    const WordType before = rowsBefore(w);
    bits &= ~before;
    if (m_Unit[0] == 0)
    {
      return bits;
    }
    bits &= ~((before << 1) | (before >> 1));
    // Only the bits at the ends of the word have neighbors in other words.
    constexpr WordType last = WordType{ 1 } << (MedialVoxelBits::BitsPerWord - 1);
    if ((bits & 1u) != 0)
    {
      bits &= ~(rowsBefore(w - 1) >> (MedialVoxelBits::BitsPerWord - 1));
    }
    if ((bits & last) != 0)
    {
      bits &= ~(rowsBefore(w + 1) << (MedialVoxelBits::BitsPerWord - 1));
    }
    return bits;
  }

  void
  ChangeIfSmall(const Voxel & seed, const MedialVoxelBox & touched)
  {
    if (!m_Bits.Test(this->AddressOf(seed)))
    {
      return; // a component that began before it has changed
    }
    if (!this->InvertComponent(seed) || !this->Meets(touched))
    {
      this->InvertBack();
      return;
    }
    for (const Voxel & voxel : m_Component)
    {
      m_Changed.Invert(this->IndexOf(voxel));
    }
  }

  /** Collects the component and inverts it; false as soon as it is too large, reaches the edge of the bits or does not
   * begin at the seed. */
  bool
  InvertComponent(const Voxel & seed)
  {
    const std::int64_t first = this->AddressOf(seed);
    const WordType     alongRow = m_Unit[0] == 0 ? 2 : 7;
    m_Component.clear();
    this->Add(seed, first);
    for (std::size_t i = 0; i < m_Component.size(); ++i)
    {
      m_Checker.Count();
      const Voxel voxel = m_Component[i];
      if (this->IsAtEdge(voxel))
      {
        return false;
      }
      const std::int64_t address = this->AddressOf(voxel);
      for (unsigned int k = 0; k < m_NumberOfRows; ++k)
      {
        const Row & row = m_Rows[k];
        for (WordType bits = m_Bits.TestThree(address + row.offset) & alongRow; bits != 0; bits &= bits - 1)
        {
          const int          dx = MedialVoxelLowestBit(bits) - 1;
          const std::int64_t neighbor = address + row.offset + dx;
          if (neighbor < first || m_Component.size() == m_MaximumSize)
          {
            return false;
          }
          this->Add({ voxel.x + dx, voxel.y + row.dy, voxel.z + row.dz }, neighbor);
        }
      }
    }
    return true;
  }

  void
  Add(const Voxel & voxel, const std::int64_t address)
  {
    m_Bits.Invert(address);
    m_Component.push_back(voxel);
  }

  bool
  IsAtEdge(const Voxel & voxel) const
  {
    return voxel.x == m_Lower[0] || voxel.x == m_Upper[0] || voxel.y == m_Lower[1] || voxel.y == m_Upper[1] ||
           voxel.z == m_Lower[2] || voxel.z == m_Upper[2];
  }

  bool
  Meets(const MedialVoxelBox & box) const
  {
    return std::any_of(
      m_Component.begin(), m_Component.end(), [&](const Voxel & voxel) { return box.Contains(this->IndexOf(voxel)); });
  }

  void
  InvertBack()
  {
    for (const Voxel & voxel : m_Component)
    {
      m_Bits.Invert(this->AddressOf(voxel));
    }
  }

  MedialVoxelIndex
  IndexOf(const Voxel & voxel) const
  {
    return { { m_FirstX + voxel.x, m_Box.lower[1] + voxel.y, m_Box.lower[2] + voxel.z } };
  }

  std::int64_t
  AddressOf(const Voxel & voxel) const
  {
    return m_Bits.AddressOf(voxel.x, voxel.y, voxel.z);
  }

  std::size_t                 m_MaximumSize;
  KindBits                    m_Bits;
  MedialVoxelSparseBits &     m_Changed;
  MedialVoxelBox              m_Box;
  std::int64_t                m_FirstX;
  MedialVoxelIndex            m_Unit;
  std::array<Row, 9>          m_Rows{};
  unsigned int                m_NumberOfRows{ 0 };
  std::array<std::int64_t, 3> m_Lower; // of the edge, and none along axes of length 1
  std::array<std::int64_t, 3> m_Upper;
  std::vector<Voxel>          m_Component;
  MedialVoxelAbortChecker     m_Checker;
};

} // namespace

MedialVoxelSmallComponents::MedialVoxelSmallComponents(const MedialVoxelGrid & grid, const std::uint64_t maximumSize)
  : m_Grid(grid)
  , m_MaximumSize(grid.GetCellBox().IsEmpty() ? 0 : maximumSize)
{
  const MedialVoxelIndex unit = grid.GetUnitMargin();
  const std::int64_t     sides = unit[0] + unit[1] + unit[2] == 1 ? 2 : 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_Margin[axis] = unit[axis] * sides * static_cast<std::int64_t>(m_MaximumSize);
  }
}

std::uint64_t
MedialVoxelSmallComponents::GetBytes(const MedialVoxelBox & box) const
{
  return std::min(m_MaximumSize, static_cast<std::uint64_t>(box.NumberOfVoxels())) * sizeof(Voxel);
}

void
MedialVoxelSmallComponents::Change(const MedialVoxelBox &  box,
                                   MedialVoxelBits &       object,
                                   MedialVoxelSparseBits & changed) const
{
  if (!this->IsOn())
  {
    return;
  }
  const MedialVoxelBox seeds = box.Expanded(m_Margin).Intersection(object.GetBox());
  ComponentChange(m_Grid, m_MaximumSize, false, object, changed).Run(seeds, seeds);
  // Outside the box, object components may be surrounded by pores.
  ComponentChange(m_Grid, m_MaximumSize, true, object, changed).Run(seeds, box);
}

} // end namespace itk
