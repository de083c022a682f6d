// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelBitAppender_h
#define medialvoxelBitAppender_h

#include "BitStore.h"

#include "itkMedialVoxelObjectPredicate.h"

#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class BitAppender
 * \brief Adds any number of bits at a time to a store, which takes whole words. */
class BitAppender
{
public:
  explicit BitAppender(BitStore & store)
    : m_Store(store)
  {}

  /** Adds whether values are object. */
  template <typename TValue>
  void
  Append(const std::vector<TValue> & values, const itk::MedialVoxelObjectPredicate<TValue> & predicate)
  {
    const auto count = static_cast<std::int64_t>(values.size());
    this->Extend(count);
    itk::MedialVoxelPackRow(values.data(), m_NumberOfBits, count, predicate, m_Words.data());
    this->StoreWords(count);
  }

  /** Adds all bits of a box of whole rows. */
  void
  Append(const itk::MedialVoxelBits & bits);

  /** Stores what is left. */
  void
  Finish();

private:
  void
  Extend(std::int64_t count);

  void
  StoreWords(std::int64_t count);

  BitStore &                      m_Store;
  std::vector<BitStore::WordType> m_Words;             ///< not stored yet
  std::int64_t                    m_NumberOfBits{ 0 }; ///< of them
};

} // end namespace medialvoxel

#endif
