// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CellSample.h"

namespace medialvoxel
{

CellSample::CellSample(const std::uint64_t voxels, const std::uint64_t fullVoxels)
{
  constexpr unsigned int largestStep = 64;
  while (voxels / m_Step > fullVoxels && m_Step < largestStep)
  {
    m_Step *= 2;
  }
  m_EveryStep = 0;
  for (unsigned int bit = 0; bit < itk::MedialVoxelBits::BitsPerWord; bit += m_Step)
  {
    m_EveryStep |= itk::MedialVoxelBits::WordType{ 1 } << bit;
  }
}

bool
CellSample::Contains(const itk::MedialVoxelIndex & cell) const
{
  return (static_cast<std::uint64_t>(cell[0]) & (m_Step - 1)) == this->GetPhase(cell);
}

itk::MedialVoxelBits::WordType
CellSample::Select(const itk::MedialVoxelCellRow & row) const
{
  // Steps divide the 64 cells of a row.
  const std::uint64_t first = (this->GetPhase(row.first) - static_cast<std::uint64_t>(row.first[0])) & (m_Step - 1);
  return m_EveryStep << first;
}

std::uint64_t
CellSample::GetPhase(const itk::MedialVoxelIndex & cell) const
{
  std::uint64_t mixed = static_cast<std::uint64_t>(cell[1]) * 0x9E3779B97F4A7C15u;
  mixed ^= static_cast<std::uint64_t>(cell[2]) * 0xC2B2AE3D27D4EB4Fu;
  return (mixed ^ (mixed >> 29)) * 0x165667B19E3779F9u >> 40 & (m_Step - 1);
}

} // end namespace medialvoxel
