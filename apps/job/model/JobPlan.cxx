// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobPlan.h"

#include <algorithm>

namespace medialvoxel
{

std::string
FormatSlices(const SliceRange & slices)
{
  return std::to_string(slices.begin) + "-" + std::to_string(slices.end - 1);
}

SliceRange
JobPlan::GetPiece(std::uint64_t piece) const
{
  // None is larger than the one before, so that the memory of its results serves again.
  const std::uint64_t units = this->GetNumberOfUnits();
  const std::uint64_t perPiece = units / divisions;
  const std::uint64_t largerPieces = units % divisions;
  const std::uint64_t begin = piece * perPiece + std::min(piece, largerPieces);
  const std::uint64_t end = begin + perPiece + (piece < largerPieces ? 1 : 0);
  return { begin * sliceUnit, std::min(end * sliceUnit, numberOfSlices) };
}

std::uint64_t
JobPlan::GetEngineLimit(std::uint64_t slices) const
{
  if (memory.limit == NoMemoryLimit)
  {
    return 0;
  }
  const std::uint64_t other = memory.fixed + this->GetResults(slices);
  return std::max<std::uint64_t>(1, (memory.limit - std::min(memory.limit, other)) / numberOfEngines);
}

std::uint64_t
JobPlan::GetMaximumSlices() const
{
  return this->GetPiece(0).end;
}

std::uint64_t
JobPlan::GetSlicesAtOnce() const
{
  const std::uint64_t slices = this->GetMaximumSlices();
  return slicesAtOnce == 0 ? slices : std::min(slices, slicesAtOnce);
}

} // end namespace medialvoxel
