// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelRecordBlocks_h
#define medialvoxelRecordBlocks_h

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** \class RecordBlocks
 * \brief Single records of a scratch file; fast when successive calls ask for neighbors, like the corners of
 * successive faces. */
template <typename TRecord>
class RecordBlocks
{
public:
  /** Reads \a count records from number \a first on. */
  using Read = std::function<void(std::uint64_t first, std::uint64_t count, std::vector<TRecord> & records)>;

  RecordBlocks(std::uint64_t numberOfRecords, Read read)
    : m_NumberOfRecords(numberOfRecords)
    , m_Read(std::move(read))
    , m_Slots(NumberOfSlots)
  {}

  const TRecord &
  Get(std::uint64_t number)
  {
    const std::uint64_t block = number / BlockSize;
    Slot &              slot = m_Slots[block % NumberOfSlots];
    if (slot.block != block)
    {
      const std::uint64_t first = block * BlockSize;
      m_Read(first, std::min(BlockSize, m_NumberOfRecords - first), slot.records);
      slot.block = block;
    }
    return slot.records[number % BlockSize];
  }

private:
  static constexpr std::uint64_t BlockSize = 1024;
  static constexpr std::uint64_t NumberOfSlots = 512;
  static constexpr std::uint64_t NoBlock = ~std::uint64_t{ 0 };

  struct Slot
  {
    std::uint64_t        block{ NoBlock };
    std::vector<TRecord> records;
  };

  std::uint64_t     m_NumberOfRecords;
  Read              m_Read;
  std::vector<Slot> m_Slots;
};

} // end namespace medialvoxel

#endif
