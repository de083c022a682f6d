// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzOracle_h
#define FuzzOracle_h

#include "FuzzScene.h"

#include "MedialVoxelTestClassification.h"

#include <optional>

namespace MedialVoxelFuzz
{

/** What a run of the core is asked for. */
struct Question
{
  MedialVoxelTest::Bound bound{ MedialVoxelTest::Bound::FreeSpace };
  std::optional<double>  thickness;               ///< unset: automatic
  double                 minimumThickness{ 0.0 }; ///< 0: the default
  double                 maximumThickness{ 0.0 }; ///< 0: the default
  std::optional<int>     maximumPoreSize;         ///< unset: the default
};

/** A thickness that the length of a path of up to \a edges edges decides to the last bit, where there is one. */
double
ChooseThicknessOfPath(Choices & choices, const MedialVoxelTest::Volume & volume, int edges);

/** A length that fits the spacing: 1 for the usual ones. */
double
UnitOf(const MedialVoxelTest::Volume & volume);

Question
ChooseQuestion(Choices & choices, const MedialVoxelTest::Volume & volume);

/** The volume without the pores and the dust that a question leaves out. */
MedialVoxelTest::Volume
CleanedByBruteForce(const MedialVoxelTest::Volume & volume, const Question & question);

/** Voxels that are object in \a volume and not in \a other. */
std::size_t
CountVoxelsOnlyIn(const MedialVoxelTest::Volume & volume, const MedialVoxelTest::Volume & other);

/** Labels and counts by brute force; nothing where a path has, but for rounding, the length that decides, and brute
 * force would take too long to find out. */
std::optional<MedialVoxelTest::Classification>
AnswerByBruteForce(const MedialVoxelTest::Volume & volume, const Question & question);

/** Quadrilaterals of the surface: voxel edges with four cells around them that it crosses, between neighbors, of which
 * one is object, whose nearest boundary points are epsilon apart, less fins and scraps. Nothing as above. */
std::optional<std::size_t>
CountFacesByBruteForce(const MedialVoxelTest::Volume & volume, const Question & question);

/** Thickness of the wall at medial cells, zero elsewhere; NaN where the definition divides by zero. */
std::vector<double>
ThicknessByBruteForce(const MedialVoxelTest::Volume & volume, const std::vector<unsigned char> & labels);

/** Displacements N(v) - v in space where \a wanted is not 0, zero elsewhere; NaN without a boundary. */
std::vector<std::array<float, 3>>
VectorsByBruteForce(const Scene &                      scene,
                    const MedialVoxelTest::Volume &    volume,
                    MedialVoxelTest::BoundarySide      side,
                    const std::vector<unsigned char> & wanted);

} // namespace MedialVoxelFuzz

#endif
