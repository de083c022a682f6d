// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSliceCache_h
#define medialvoxelSliceCache_h

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace medialvoxel
{

/** \class SliceCache
 * \brief The decoded slices that were used last, shared by threads: none is decoded twice while it is kept. */
class SliceCache
{
public:
  using Slice = std::shared_ptr<const std::vector<char>>;

  /** A slice by its number. The first thread calls decode(); others wait meanwhile.
   * \param capacity slices that are kept, with slices in decoding; 1 or more
   * \throw the errors of decode() */
  Slice
  Get(std::uint64_t number, std::size_t capacity, const std::function<Slice()> & decode);

private:
  struct Entry
  {
    Slice         slice; ///< null: in decoding
    std::uint64_t lastUse{ 0 };
  };

  /** Drops the least recently used slices, until there is room for one. */
  void
  MakeRoom(std::size_t capacity);

  std::mutex                     m_Mutex;
  std::condition_variable        m_Decoded;
  std::map<std::uint64_t, Entry> m_Entries;
  std::uint64_t                  m_Uses{ 0 };
};

} // end namespace medialvoxel

#endif
