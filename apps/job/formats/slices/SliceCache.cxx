// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SliceCache.h"

namespace medialvoxel
{

SliceCache::Slice
SliceCache::Get(std::uint64_t number, std::size_t capacity, const std::function<Slice()> & decode)
{
  std::unique_lock<std::mutex> lock(m_Mutex);
  for (auto found = m_Entries.find(number); found != m_Entries.end(); found = m_Entries.find(number))
  {
    if (found->second.slice)
    {
      found->second.lastUse = ++m_Uses;
      return found->second.slice;
    }
    m_Decoded.wait(lock);
  }
  this->MakeRoom(capacity);
  m_Entries[number] = {};
  lock.unlock();
  Slice slice;
  try
  {
    slice = decode();
  }
  catch (...)
  {
    lock.lock();
    m_Entries.erase(number);
    m_Decoded.notify_all();
    throw;
  }
  lock.lock();
  m_Entries[number] = { slice, ++m_Uses };
  m_Decoded.notify_all();
  return slice;
}

void
SliceCache::MakeRoom(std::size_t capacity)
{
  while (m_Entries.size() >= capacity)
  {
    auto oldest = m_Entries.end();
    for (auto entry = m_Entries.begin(); entry != m_Entries.end(); ++entry)
    {
      if (entry->second.slice && (oldest == m_Entries.end() || entry->second.lastUse < oldest->second.lastUse))
      {
        oldest = entry;
      }
    }
    if (oldest == m_Entries.end())
    {
      return; // all are in decoding
    }
    m_Entries.erase(oldest);
  }
}

} // end namespace medialvoxel
