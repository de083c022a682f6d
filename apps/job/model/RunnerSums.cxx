// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "RunnerSums.h"

namespace medialvoxel
{

RunnerSums &
RunnerSums::operator+=(const RunnerSums & other)
{
  counts += other.counts;
  recomputedVoxels += other.recomputedVoxels;
  distanceSeconds += other.distanceSeconds;
  classificationSeconds += other.classificationSeconds;
  threadSeconds += other.threadSeconds;
  tileSeconds += other.tileSeconds;
  return *this;
}

RunnerSums
RunnerSums::Since(const RunnerSums & earlier) const
{
  RunnerSums sums = *this;
  for (const NamedCount & count : NamedCounts)
  {
    sums.counts.*count.member -= earlier.counts.*count.member;
  }
  sums.recomputedVoxels -= earlier.recomputedVoxels;
  sums.distanceSeconds -= earlier.distanceSeconds;
  sums.classificationSeconds -= earlier.classificationSeconds;
  sums.threadSeconds -= earlier.threadSeconds;
  sums.tileSeconds -= earlier.tileSeconds;
  return sums;
}

} // end namespace medialvoxel
