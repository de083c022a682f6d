// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceSums.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

/** The members that other processes get. */
template <typename TSums, typename TNumbers>
void
Exchange(TSums & sums, TNumbers & numbers)
{
  numbers.Exchange(sums.cells);
  numbers.Exchange(sums.area);
  numbers.Exchange(sums.areaBeyond);
  numbers.Exchange(sums.thickness);
  numbers.Exchange(sums.minimum);
  numbers.Exchange(sums.maximum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    numbers.Exchange(sums.first[axis]);
    numbers.Exchange(sums.last[axis]);
    numbers.Exchange(sums.worst.a[axis]);
    numbers.Exchange(sums.worst.b[axis]);
  }
  numbers.Exchange(sums.worst.key);
  numbers.Exchange(sums.worst.thickness);
  numbers.Exchange(sums.worst.area);
  numbers.Exchange(sums.hasBegun);
}

} // namespace

void
PlaceSums::Add(const PlaceCell & cell, const PlaceRule & rule, const PlaceGrid & grid)
{
  this->TakeWorst(cell, rule);
  ++cells;
  area += cell.area;
  thickness += static_cast<std::uint64_t>(std::llround(static_cast<double>(cell.thickness) / rule.lengthUnit));
  minimum = std::min(minimum, cell.thickness);
  maximum = std::max(maximum, cell.thickness);
  const itk::MedialVoxelIndex index = grid.GetCell(cell.key);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto position = static_cast<std::int32_t>(index[axis]);
    first[axis] = std::min(first[axis], position);
    last[axis] = std::max(last[axis], position);
  }
  if (rule.Begins(cell.thickness))
  {
    hasBegun = true;
    areaBeyond += cell.area;
  }
}

void
PlaceSums::Add(const PlaceSums & other, const PlaceRule & rule)
{
  this->TakeWorst(other.worst, rule);
  cells += other.cells;
  area += other.area;
  areaBeyond += other.areaBeyond;
  thickness += other.thickness;
  minimum = std::min(minimum, other.minimum);
  maximum = std::max(maximum, other.maximum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    first[axis] = std::min(first[axis], other.first[axis]);
    last[axis] = std::max(last[axis], other.last[axis]);
  }
  hasBegun = hasBegun || other.hasBegun;
}

/** Before the sums know of the cell. */
void
PlaceSums::TakeWorst(const PlaceCell & cell, const PlaceRule & rule)
{
  const bool isWorse =
    rule.kind == PlaceKind::Thin ? cell.thickness < worst.thickness : cell.thickness > worst.thickness;
  if (cells == 0 || isWorse || (cell.thickness == worst.thickness && cell.key < worst.key))
  {
    worst = cell;
  }
}

void
PlaceSums::Save(NumberWriter & numbers) const
{
  Exchange(*this, numbers);
}

PlaceSums
PlaceSums::Load(NumberReader & numbers)
{
  PlaceSums sums;
  Exchange(sums, numbers);
  if (sums.cells == 0)
  {
    RefuseSaved();
  }
  return sums;
}

} // end namespace medialvoxel
