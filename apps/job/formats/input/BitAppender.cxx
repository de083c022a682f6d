// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BitAppender.h"

namespace medialvoxel
{

void
BitAppender::Append(const itk::MedialVoxelBits & bits)
{
  const itk::MedialVoxelBox & box = bits.GetBox();
  const auto first = static_cast<std::uint64_t>(box.lower[0] - bits.GetFirstWord() * itk::MedialVoxelBits::BitsPerWord);
  const auto count = box.NumberOfVoxels();
  this->Extend(count);
  std::int64_t x = m_NumberOfBits;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y, x += box.Extent(0))
    {
      CopyBits(bits.GetRow(y, z), first, x, box.Extent(0), m_Words.data());
    }
  }
  this->StoreWords(count);
}

void
BitAppender::Finish()
{
  m_Store.Append(m_Words);
  m_Words.clear();
  m_NumberOfBits = 0;
}

void
BitAppender::Extend(std::int64_t count)
{
  m_Words.resize(GetBitStoreBytes(static_cast<std::uint64_t>(m_NumberOfBits + count)) / sizeof(BitStore::WordType), 0);
}

void
BitAppender::StoreWords(std::int64_t count)
{
  constexpr std::int64_t bitsPerWord = BitStore::BitsPerWord;
  m_NumberOfBits += count;
  const bool                      hasRest = m_NumberOfBits % bitsPerWord != 0;
  std::vector<BitStore::WordType> rest;
  if (hasRest)
  {
    rest.push_back(m_Words.back());
    m_Words.pop_back();
  }
  m_Store.Append(m_Words);
  m_Words = rest;
  m_NumberOfBits %= bitsPerWord;
}

} // end namespace medialvoxel
