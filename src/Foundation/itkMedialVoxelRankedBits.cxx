// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRankedBits.h"

namespace itk
{

void
MedialVoxelRankedBits::Reshape(const MedialVoxelBox & box)
{
  m_Bits.Reshape(box);
  m_NumberOfBits = 0;
}

void
MedialVoxelRankedBits::Rank()
{
  const MedialVoxelBox & box = m_Bits.GetBox();
  m_Before.clear();
  m_NumberOfBits = 0;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const WordType * const row = m_Bits.GetRow(y, z);
      for (std::int64_t i = 0; i < m_Bits.GetWordsPerRow(); ++i)
      {
        m_Before.push_back(static_cast<std::uint32_t>(m_NumberOfBits));
        m_NumberOfBits += static_cast<std::size_t>(MedialVoxelPopulationCount(row[i]));
      }
    }
  }
}

} // end namespace itk
