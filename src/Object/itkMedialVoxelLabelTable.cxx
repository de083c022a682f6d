// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLabelTable.h"

#include <utility>

namespace itk
{

MedialVoxelLabelTable::MedialVoxelLabelTable(std::vector<std::int64_t> values)
  : m_Values(std::move(values))
{
  constexpr std::uint64_t mostEntries = std::uint64_t{ 1 } << 20;
  if (m_Values.empty())
  {
    return;
  }
  // As numbers without a sign, whose difference does not overflow.
  const std::uint64_t last = static_cast<std::uint64_t>(m_Values.back()) - static_cast<std::uint64_t>(m_Values.front());
  if (last >= mostEntries)
  {
    return;
  }
  m_Near.assign(last + 1, 0);
  for (std::size_t i = 0; i < m_Values.size(); ++i)
  {
    m_Near[static_cast<std::size_t>(m_Values[i] - m_Values.front())] = static_cast<MedialVoxelObjectNumber>(i + 1);
  }
}

} // end namespace itk
