// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFloodPrivate_h
#define itkMedialVoxelFloodPrivate_h

#include "itkMedialVoxelBits.h"

#include <array>
#include <cassert>
#include <cstdint>

namespace itk
{

#if defined(__GNUC__)
/** Two words that are shifted and combined at once. A loop over an array would go through memory each time. */
using MedialVoxelWordPair [[gnu::vector_size(16)]] = MedialVoxelBits::WordType;
#else
struct MedialVoxelWordPair
{
  using WordType = MedialVoxelBits::WordType;

  WordType words[2];

  WordType
  operator[](const int i) const
  {
    return words[i];
  }
  MedialVoxelWordPair
  operator|(const MedialVoxelWordPair & other) const
  {
    return { words[0] | other[0], words[1] | other[1] };
  }
  MedialVoxelWordPair
  operator&(const MedialVoxelWordPair & other) const
  {
    return { words[0] & other[0], words[1] & other[1] };
  }
  MedialVoxelWordPair
  operator^(const MedialVoxelWordPair & other) const
  {
    return { words[0] ^ other[0], words[1] ^ other[1] };
  }
  MedialVoxelWordPair
  operator&(const WordType mask) const
  {
    return { words[0] & mask, words[1] & mask };
  }
  MedialVoxelWordPair
  operator<<(const int bits) const
  {
    return { words[0] << bits, words[1] << bits };
  }
  MedialVoxelWordPair
  operator>>(const int bits) const
  {
    return { words[0] >> bits, words[1] >> bits };
  }
};
#endif

/** A set of the voxels of a window: a word per slice, eight rows of eight bits each; two slices side by side. */
struct MedialVoxelPlaneLayout
{
  using WordType = MedialVoxelBits::WordType;

  /** Bits of a row, rows of a slice, and slices. */
  static constexpr int Edge = 8;

  struct Set
  {
    MedialVoxelWordPair a;
    MedialVoxelWordPair b;
    MedialVoxelWordPair c;
    MedialVoxelWordPair d;
  };

  static constexpr WordType FirstColumn = 0x0101010101010101u;

  static Set
  Load(const std::array<WordType, Edge> & w)
  {
    return { MedialVoxelWordPair{ w[0], w[1] },
             MedialVoxelWordPair{ w[2], w[3] },
             MedialVoxelWordPair{ w[4], w[5] },
             MedialVoxelWordPair{ w[6], w[7] } };
  }
  static Set
  Point(const std::uint16_t bit)
  {
    std::array<WordType, Edge> words{};
    words[bit >> 6] = WordType{ 1 } << (bit & 63);
    return Load(words);
  }
  static bool
  IsAny(const MedialVoxelWordPair pair)
  {
    return (pair[0] | pair[1]) != 0;
  }
  static bool
  Meet(const Set & s, const Set & t)
  {
    return IsAny((s.a & t.a) | (s.b & t.b) | (s.c & t.c) | (s.d & t.d));
  }
  static bool
  Equal(const Set & s, const Set & t)
  {
    return !IsAny((s.a ^ t.a) | (s.b ^ t.b) | (s.c ^ t.c) | (s.d ^ t.d));
  }
  static MedialVoxelWordPair
  AlongX(const MedialVoxelWordPair p)
  {
    return ((p << 1) & ~FirstColumn) | ((p & ~FirstColumn) >> 1);
  }
  static Set
  AlongX(const Set & s)
  {
    return { AlongX(s.a), AlongX(s.b), AlongX(s.c), AlongX(s.d) };
  }
  static MedialVoxelWordPair
  AlongY(const MedialVoxelWordPair p)
  {
    return (p << Edge) | (p >> Edge);
  }
  static Set
  AlongY(const Set & s)
  {
    return { AlongY(s.a), AlongY(s.b), AlongY(s.c), AlongY(s.d) };
  }
  static MedialVoxelWordPair
  Between(const MedialVoxelWordPair p, const MedialVoxelWordPair q)
  {
    return MedialVoxelWordPair{ p[1], q[0] };
  }
  static Set
  AlongZ(const Set & s)
  {
    const MedialVoxelWordPair none{};
    const MedialVoxelWordPair ab = Between(s.a, s.b);
    const MedialVoxelWordPair bc = Between(s.b, s.c);
    const MedialVoxelWordPair cd = Between(s.c, s.d);
    return { Between(none, s.a) | ab, ab | bc, bc | cd, cd | Between(s.d, none) };
  }
  static Set
  Or(const Set & s, const Set & t)
  {
    return { s.a | t.a, s.b | t.b, s.c | t.c, s.d | t.d };
  }
  static Set
  And(const Set & s, const Set & t)
  {
    return { s.a & t.a, s.b & t.b, s.c & t.c, s.d & t.d };
  }
};

/** Call \a visit(bits, y, z) for the rows of \a size that begin at \a lower, with size[0] <= 8 bits each. */
template <typename TVisitor>
void
MedialVoxelVisitRows(const MedialVoxelBits &             boundary,
                     const MedialVoxelIndex &            lower,
                     const std::array<std::uint8_t, 3> & size,
                     TVisitor &&                         visit)
{
  using WordType = MedialVoxelBits::WordType;
  assert(size[0] <= MedialVoxelPlaneLayout::Edge);
  const auto       shift = static_cast<unsigned int>(lower[0] & (MedialVoxelBits::BitsPerWord - 1));
  const auto       columns = (WordType{ 1 } << size[0]) - 1;
  const WordType * slice =
    boundary.GetRow(lower[1], lower[2]) + ((lower[0] / MedialVoxelBits::BitsPerWord) - boundary.GetFirstWord());
  const std::int64_t rowPitch = boundary.GetRowPitch();
  const std::int64_t slicePitch = rowPitch * boundary.GetBox().Extent(1);
  const bool         isInOneWord = shift + size[0] <= MedialVoxelBits::BitsPerWord;
  for (unsigned int z = 0; z < size[2]; ++z, slice += slicePitch)
  {
    const WordType * row = slice;
    if (isInOneWord)
    {
      for (unsigned int y = 0; y < size[1]; ++y, row += rowPitch)
      {
        visit((row[0] >> shift) & columns, y, z);
      }
    }
    else
    {
      for (unsigned int y = 0; y < size[1]; ++y, row += rowPitch)
      {
        visit(((row[0] >> shift) | (row[1] << (MedialVoxelBits::BitsPerWord - shift))) & columns, y, z);
      }
    }
  }
}

/** The voxels of a box of at most eight along each axis. */
inline MedialVoxelPlaneLayout::Set
MedialVoxelLoadPlanes(const MedialVoxelBits &             boundary,
                      const MedialVoxelIndex &            lower,
                      const std::array<std::uint8_t, 3> & size)
{
  using WordType = MedialVoxelBits::WordType;
  constexpr auto             edge = static_cast<unsigned int>(MedialVoxelPlaneLayout::Edge);
  std::array<WordType, edge> planes{};
  assert(size[1] <= edge && size[2] <= edge);
  MedialVoxelVisitRows(boundary, lower, size, [&](const WordType bits, const unsigned int y, const unsigned int z) {
    planes[z] |= bits << (edge * y);
  });
  return MedialVoxelPlaneLayout::Load(planes);
}

/** Edges of the path with fewest edges from \a start to \a target, which differ, through \a domain; 0 when it has more
 * than \a mostEdges, or when there is none. */
template <typename TLayout>
std::int64_t
MedialVoxelFlood(const TLayout &               layout,
                 const typename TLayout::Set & domain,
                 const typename TLayout::Set & start,
                 const typename TLayout::Set & target,
                 const std::int64_t            mostEdges)
{
  auto reached = start;
  for (std::int64_t edges = 1; edges <= mostEdges; ++edges)
  {
    auto next = TLayout::Or(reached, layout.AlongX(reached));
    next = TLayout::Or(next, layout.AlongY(next));
    next = TLayout::And(TLayout::Or(next, layout.AlongZ(next)), domain);
    if (TLayout::Meet(next, target))
    {
      return edges;
    }
    if (TLayout::Equal(next, reached))
    {
      return 0;
    }
    reached = next;
  }
  return 0;
}

} // end namespace itk

#endif
