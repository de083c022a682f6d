// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BitStore.h"

#include "ScratchFile.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

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
