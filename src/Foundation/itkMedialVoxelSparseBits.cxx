// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSparseBits.h"

#include <algorithm>
#include <utility>

namespace itk
{

MedialVoxelSparseBits::MedialVoxelSparseBits(const MedialVoxelBox & box)
  : m_Box(box)
  , m_Slices(box.IsEmpty() ? 0 : static_cast<std::size_t>(box.Extent(2)))
{}

std::int64_t
MedialVoxelSparseBits::BlocksPerRow(const MedialVoxelBox & box)
{
  constexpr std::int64_t bits = WordsPerBlock * MedialVoxelBits::BitsPerWord;
  return (box.upper[0] - 1) / bits - box.lower[0] / bits + 1;
}

std::size_t
MedialVoxelSparseBits::BlocksPerSlice(const MedialVoxelBox & box)
{
  return static_cast<std::size_t>(BlocksPerRow(box) * box.Extent(1));
}

/** While the blocks of one slice become more, there are old and new ones. */
std::uint64_t
MedialVoxelSparseBits::GetBytes(const MedialVoxelBox & box)
{
  if (box.IsEmpty())
  {
    return 0;
  }
  const std::uint64_t places = BlocksPerSlice(box);
  const std::uint64_t bytesOfSlice = sizeof(Slice) + places * (sizeof(std::uint32_t) + sizeof(Block));
  return static_cast<std::uint64_t>(box.Extent(2)) * bytesOfSlice + places * sizeof(Block);
}

std::uint64_t
MedialVoxelSparseBits::GetReservedBytes() const
{
  std::uint64_t bytes = m_Slices.capacity() * sizeof(Slice);
  for (const Slice & slice : m_Slices)
  {
    bytes += slice.numbers.capacity() * sizeof(std::uint32_t) + slice.blocks.capacity() * sizeof(Block);
  }
  return bytes;
}

bool
MedialVoxelSparseBits::HasSameSlices(const MedialVoxelBox & box) const
{
  return box.lower[0] == m_Box.lower[0] && box.upper[0] == m_Box.upper[0] && box.lower[1] == m_Box.lower[1] &&
         box.upper[1] == m_Box.upper[1];
}

void
MedialVoxelSparseBits::Reframe(const MedialVoxelBox & box)
{
  if (!this->HasSameSlices(box))
  {
    const MedialVoxelSparseBits old = std::exchange(*this, MedialVoxelSparseBits(box));
    this->CopyFrom(old, box);
    return;
  }
  MedialVoxelSparseBits result(box);
  const MedialVoxelBox  shared = box.Intersection(m_Box);
  for (std::int64_t z = shared.lower[2]; z < shared.upper[2]; ++z)
  {
    result.m_Slices[static_cast<std::size_t>(z - box.lower[2])] =
      std::move(m_Slices[static_cast<std::size_t>(z - m_Box.lower[2])]);
  }
  *this = std::move(result);
}

void
MedialVoxelSparseBits::CopyFrom(const MedialVoxelSparseBits & source, const MedialVoxelBox & box)
{
  *this = MedialVoxelSparseBits(box);
  source.VisitWords(box,
                    [this](const WordType bits, const std::int64_t word, const std::int64_t y, const std::int64_t z) {
                      this->GetWord(word, y, z) = bits;
                    });
}

std::size_t
MedialVoxelSparseBits::PlaceOf(const std::int64_t word, const std::int64_t y) const
{
  constexpr std::int64_t bits = WordsPerBlock * MedialVoxelBits::BitsPerWord;
  return static_cast<std::size_t>((y - m_Box.lower[1]) * BlocksPerRow(m_Box) + word / WordsPerBlock -
                                  m_Box.lower[0] / bits);
}

auto
MedialVoxelSparseBits::GetWord(const std::int64_t word, const std::int64_t y, const std::int64_t z) -> WordType &
{
  Slice &           slice = m_Slices[static_cast<std::size_t>(z - m_Box.lower[2])];
  const std::size_t places = BlocksPerSlice(m_Box);
  if (slice.numbers.empty())
  {
    slice.numbers.resize(places);
  }
  std::uint32_t & number = slice.numbers[this->PlaceOf(word, y)];
  if (number == 0)
  {
    if (slice.blocks.size() == slice.blocks.capacity())
    {
      slice.blocks.reserve(std::min(places, slice.blocks.size() * 2 + 1));
    }
    slice.blocks.emplace_back();
    number = static_cast<std::uint32_t>(slice.blocks.size());
  }
  return slice.blocks[number - 1][static_cast<std::size_t>(word % WordsPerBlock)];
}

bool
MedialVoxelSparseBits::Test(const MedialVoxelIndex & index) const
{
  bool isSet = false;
  this->VisitWords(
    { index, { { index[0] + 1, index[1] + 1, index[2] + 1 } } },
    [&isSet](const WordType, const std::int64_t, const std::int64_t, const std::int64_t) { isSet = true; });
  return isSet;
}

} // end namespace itk
