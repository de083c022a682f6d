// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceSums.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace medialvoxel
{
namespace
{

void
AddFloat(NumberWriter & numbers, float value)
{
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  numbers.Add(bits);
}

float
GetFloat(NumberReader & numbers)
{
  const auto bits = static_cast<std::uint32_t>(numbers.Get());
  float      value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
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
  for (const std::uint64_t number : { cells, area, areaBeyond, thickness })
  {
    numbers.Add(number);
  }
  AddFloat(numbers, minimum);
  AddFloat(numbers, maximum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    numbers.AddSigned(first[axis]);
    numbers.AddSigned(last[axis]);
    numbers.AddSigned(worst.a[axis]);
    numbers.AddSigned(worst.b[axis]);
  }
  numbers.AddSigned(worst.key);
  AddFloat(numbers, worst.thickness);
  numbers.Add(worst.area);
  numbers.Add(hasBegun ? 1 : 0);
}

PlaceSums
PlaceSums::Load(NumberReader & numbers)
{
  PlaceSums sums;
  sums.cells = numbers.Get();
  sums.area = numbers.Get();
  sums.areaBeyond = numbers.Get();
  sums.thickness = numbers.Get();
  sums.minimum = GetFloat(numbers);
  sums.maximum = GetFloat(numbers);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    sums.first[axis] = static_cast<std::int32_t>(numbers.GetSigned());
    sums.last[axis] = static_cast<std::int32_t>(numbers.GetSigned());
    sums.worst.a[axis] = static_cast<std::int32_t>(numbers.GetSigned());
    sums.worst.b[axis] = static_cast<std::int32_t>(numbers.GetSigned());
  }
  sums.worst.key = numbers.GetSigned();
  sums.worst.thickness = GetFloat(numbers);
  sums.worst.area = static_cast<std::uint32_t>(numbers.Get());
  sums.hasBegun = numbers.Get() != 0;
  if (sums.cells == 0)
  {
    RefusePart();
  }
  return sums;
}

} // end namespace medialvoxel
