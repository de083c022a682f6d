// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzOracle_h
#define FuzzOracle_h

#include "MedialVoxelTestClassification.h"

#include <optional>

namespace MedialVoxelFuzz
{

/** What a run of the core is asked for, and what the answer depends on. */
struct Question
{
  MedialVoxelTest::Volume volume;
  MedialVoxelTest::Bound  bound{ MedialVoxelTest::Bound::FreeSpace };
  std::optional<double>   thickness; ///< unset: automatic
  double                  minimumThickness{ 3.0 };
  double                  maximumThickness{ 16.0 };
};

/** Labels and counts by brute force; nothing where a path has, but for rounding, the length that decides. */
std::optional<MedialVoxelTest::Classification>
AnswerByBruteForce(const Question & question);

/** N(v) - v as physical displacements at object voxels, by brute force; empty without any boundary. */
std::vector<std::array<float, 3>>
VectorsByBruteForce(const MedialVoxelTest::Volume & volume, MedialVoxelTest::BoundarySide side);

} // namespace MedialVoxelFuzz

#endif
