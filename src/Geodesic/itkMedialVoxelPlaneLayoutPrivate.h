// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelPlaneLayoutPrivate_h
#define itkMedialVoxelPlaneLayoutPrivate_h

#include "itkMedialVoxelBits.h"

#include <array>
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

} // end namespace itk

#endif
