// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFeatures.h"

#include <algorithm>

namespace itk
{

void
MedialVoxelFeatures::Reset(const MedialVoxelBox & newBox)
{
  box = newBox;
  const auto size = static_cast<std::size_t>(newBox.NumberOfVoxels());
  for (auto * const component : { &dx, &dy, &dz })
  {
    if (size > component->capacity())
    {
      // Free the old memory first, so that both never exist at the same time.
      std::vector<std::int32_t>().swap(*component);
      component->resize(size);
      continue;
    }
    for (const Run & run : m_Written)
    {
      std::fill_n(component->begin() + static_cast<std::ptrdiff_t>(run.offset), run.number, 0);
    }
    component->resize(size);
  }
  m_Written.clear();
}

void
MedialVoxelFeatures::MarkWritten(const std::size_t offset, const std::size_t number)
{
  if (!m_Written.empty() && m_Written.back().offset + m_Written.back().number == offset)
  {
    m_Written.back().number += number;
  }
  else
  {
    m_Written.push_back({ offset, number });
  }
}

} // end namespace itk
