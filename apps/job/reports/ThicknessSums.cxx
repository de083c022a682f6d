// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ThicknessSums.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t UnitsPerRoot = 1024;

} // namespace

void
ThicknessSums::AddWall(const itk::MedialVoxelWall & wall, const double areaUnit)
{
  if (wall.isUnpaired)
  {
    ++m_UnpairedCells;
    return;
  }
  if (wall.isUnresolved)
  {
    ++m_UnresolvedCells;
    return;
  }
  this->AddCell(wall.thickness, static_cast<std::uint64_t>(std::llround(static_cast<double>(wall.area) / areaUnit)));
  if (!std::isnan(wall.uncertainty))
  {
    m_Uncertainty.Add(m_Uncertainty.GetBin(static_cast<double>(wall.uncertainty)));
  }
}

void
ThicknessSums::AddCell(const float thickness, const std::uint64_t area)
{
  const std::size_t   bin = m_Cells.GetBin(static_cast<double>(thickness));
  const std::uint64_t root = (area + UnitsPerRoot / 2) / UnitsPerRoot;
  m_Cells.Add(bin);
  m_Areas.Add(bin, area);
  m_SquaredAreas += root * root;
  m_Minimum = std::min(m_Minimum, thickness);
  m_Maximum = std::max(m_Maximum, thickness);
}

void
ThicknessSums::Add(const ThicknessSums & other)
{
  m_Cells.Add(other.m_Cells);
  m_Areas.Add(other.m_Areas);
  m_SquaredAreas += other.m_SquaredAreas;
  m_Minimum = std::min(m_Minimum, other.m_Minimum);
  m_Maximum = std::max(m_Maximum, other.m_Maximum);
  m_UnpairedCells += other.m_UnpairedCells;
  m_Uncertainty.Add(other.m_Uncertainty);
  m_UnresolvedCells += other.m_UnresolvedCells;
}

void
ThicknessSums::Clear()
{
  *this = ThicknessSums(m_Cells.GetBinWidth());
}

double
ThicknessSums::GetStandardErrorOfMean(const unsigned int step) const
{
  if (m_Areas.GetTotal() == 0)
  {
    return 0.0;
  }
  const double share = 1.0 - 1.0 / static_cast<double>(step); // the cells that count are known
  const double areas = static_cast<double>(m_Areas.GetTotal()) / static_cast<double>(UnitsPerRoot);
  return m_Areas.GetStandardDeviation() * std::sqrt(share * static_cast<double>(m_SquaredAreas)) / areas;
}

} // end namespace medialvoxel
