// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelBitStore_h
#define medialvoxelBitStore_h

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** \class BitStore
 * \brief One bit per voxel of a volume, x fastest, without gaps; the lowest bit of a word is its first voxel. */
class BitStore
{
public:
  using WordType = std::uint64_t;

  static constexpr std::uint64_t BitsPerWord = 64;

  virtual ~BitStore() = default;

  /** Adds words after those that were added before. \throw JobError Failure when they cannot be stored. */
  virtual void
  Append(const std::vector<WordType> & words) = 0;

  /** Reads back words added before. \throw JobError Failure. */
  virtual void
  Read(std::uint64_t firstWord, std::uint64_t numberOfWords, WordType * words) const = 0;
};

/** Bytes of a store of so many voxels. */
constexpr std::uint64_t
GetBitStoreBytes(std::uint64_t numberOfVoxels)
{
  return (numberOfVoxels + BitStore::BitsPerWord - 1) / BitStore::BitsPerWord * sizeof(BitStore::WordType);
}

/** Sets those of \a count bits of \a words from \a first on in a row of bits, from \a x on; \a row points to its word
 * 0. */
void
CopyBits(const BitStore::WordType * words,
         std::uint64_t              first,
         std::int64_t               x,
         std::int64_t               count,
         BitStore::WordType *       row);

std::unique_ptr<BitStore>
MakeBitStoreInMemory(std::uint64_t numberOfVoxels);

/** A store in a file without a name, which vanishes with the process however it ends; its space is taken at once.
 * \throw JobError Refused when the folder is missing, cannot be written or has no space. */
std::unique_ptr<BitStore>
MakeBitStoreInFile(const std::filesystem::path & folder, std::uint64_t numberOfVoxels);

} // end namespace medialvoxel

#endif
