// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BitStore.h"

#include "ScratchFile.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

using WordType = BitStore::WordType;

/** \a count bits, 1 to 64, of \a words from bit \a first on. */
WordType
GetBits(const WordType * words, std::uint64_t first, std::uint64_t count)
{
  const WordType *    word = words + first / BitStore::BitsPerWord;
  const std::uint64_t shift = first % BitStore::BitsPerWord;
  WordType            bits = word[0] >> shift;
  if (shift + count > BitStore::BitsPerWord)
  {
    bits |= word[1] << (BitStore::BitsPerWord - shift);
  }
  return count == BitStore::BitsPerWord ? bits : bits & ((WordType{ 1 } << count) - 1);
}

class MemoryBitStore : public BitStore
{
public:
  explicit MemoryBitStore(std::uint64_t numberOfVoxels)
  {
    m_Words.reserve(GetBitStoreBytes(numberOfVoxels) / sizeof(WordType));
  }

  void
  Append(const std::vector<WordType> & words) override
  {
    m_Words.insert(m_Words.end(), words.begin(), words.end());
  }

  void
  Read(std::uint64_t firstWord, std::uint64_t numberOfWords, WordType * words) const override
  {
    std::copy_n(m_Words.data() + firstWord, numberOfWords, words);
  }

private:
  std::vector<WordType> m_Words;
};

class FileBitStore : public BitStore
{
public:
  FileBitStore(const std::filesystem::path & folder, std::uint64_t numberOfVoxels)
    : m_File(folder)
  {
    m_File.Reserve(GetBitStoreBytes(numberOfVoxels));
  }

  void
  Append(const std::vector<WordType> & words) override
  {
    m_File.WriteAt(m_AppendedWords * sizeof(WordType), words.data(), words.size() * sizeof(WordType));
    m_AppendedWords += words.size();
  }

  void
  Read(std::uint64_t firstWord, std::uint64_t numberOfWords, WordType * words) const override
  {
    m_File.ReadAt(firstWord * sizeof(WordType), words, numberOfWords * sizeof(WordType));
  }

private:
  ScratchFile   m_File;
  std::uint64_t m_AppendedWords{ 0 };
};

} // namespace

void
CopyBits(const BitStore::WordType * words,
         std::uint64_t              first,
         std::int64_t               x,
         std::int64_t               count,
         BitStore::WordType *       row)
{
  constexpr std::int64_t bitsPerWord = BitStore::BitsPerWord;
  for (const std::int64_t end = x + count; x < end;)
  {
    const std::int64_t next = std::min((x / bitsPerWord + 1) * bitsPerWord, end);
    const auto         number = static_cast<std::uint64_t>(next - x);
    row[x / bitsPerWord] |= GetBits(words, first, number) << (x % bitsPerWord);
    first += number;
    x = next;
  }
}

std::unique_ptr<BitStore>
MakeBitStoreInMemory(std::uint64_t numberOfVoxels)
{
  return std::make_unique<MemoryBitStore>(numberOfVoxels);
}

std::unique_ptr<BitStore>
MakeBitStoreInFile(const std::filesystem::path & folder, std::uint64_t numberOfVoxels)
{
  return std::make_unique<FileBitStore>(folder, numberOfVoxels);
}

} // end namespace medialvoxel
