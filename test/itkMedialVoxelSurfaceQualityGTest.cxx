// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestSurfaceObjects.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace MedialVoxelTest;

constexpr double Goal = 0.06;          // mean distance to the true mid-surface, in voxels
constexpr double SmallestAngle99 = 26; // of which only one triangle in a hundred has less, in degrees

void
ExpectGoodTriangles(const SurfaceQuality & quality)
{
  EXPECT_GE(quality.AngleOfOneInHundred(), SmallestAngle99);
}
} // namespace

TEST(MedialVoxelSurfaceQuality, AShellIsOneClosedSurface)
{
  const Surface surface = MakeSurface(Shell(), 3.0);
  const auto    quality = MeasureQuality(surface, Nowhere, Nowhere);
  EXPECT_EQ(quality.boundarySides, 0u);
  EXPECT_EQ(quality.nonManifoldSides, 0u);
  EXPECT_EQ(quality.pieces, 1u);
  // Euler characteristic of a sphere.
  EXPECT_EQ(surface.vertices.size() + surface.quads.size(), CountSides(surface).size() + 2);
  EXPECT_LE(MeanDistance(surface, DistanceToShell, Everywhere), Goal);
  ExpectGoodTriangles(quality);

  double area = 0.0;
  for (const auto & quad : surface.quads)
  {
    area += quad.GetArea();
  }
  const double sphere = 4.0 * 3.14159265358979323846 * 24.0 * 24.0;
  EXPECT_NEAR(area, sphere, 0.02 * sphere);
}

TEST(MedialVoxelSurfaceQuality, APlateEndsAtItsRimAlone)
{
  const Surface surface = MakeSurface(TurnedPlate(), 5.0);
  const auto    quality = MeasureQuality(surface, IsRimOfPlate, Nowhere);
  EXPECT_EQ(quality.boundarySides, 0u);
  EXPECT_EQ(quality.nonManifoldSides, 0u);
  EXPECT_EQ(quality.pieces, 1u);
  EXPECT_LE(MeanDistance(surface, DistanceToPlate, Everywhere), Goal);
  ExpectGoodTriangles(quality);
}

TEST(MedialVoxelSurfaceQuality, SheetsMeetAtAJunctionAlone)
{
  const Surface surface = MakeSurface(TurnedTee(HalfThickness, HalfThickness), 5.0);
  const auto    quality = MeasureQuality(surface, IsRimOfTee, IsJunctionOfTee);
  EXPECT_EQ(quality.boundarySides, 0u);
  EXPECT_EQ(quality.nonManifoldSides, 0u);
  EXPECT_EQ(quality.pieces, 1u);
  ExpectGoodTriangles(quality);
  // At the junction the medial surface leaves the planes of the walls.
  const auto isAway = [](const Vector3 & point) { return DistanceToTeeAxis(point) > 2.0 * HalfThickness; };
  EXPECT_LE(MeanDistance(surface, DistanceToTee, isAway), Goal);
  EXPECT_LE(MeanDistance(surface, DistanceToTee, Everywhere), 0.08);
  std::size_t junctions = 0;
  for (const auto & quad : surface.quads)
  {
    junctions += quad.junctionSides != 0 ? 1 : 0;
  }
  EXPECT_GT(junctions, static_cast<std::size_t>(2.0 * HalfWidth)) << "the line of the junction has gaps";
}

TEST(MedialVoxelSurfaceQuality, AutomaticThicknessSuitsThickAndThinWallsTogether)
{
  const Surface surface = MakeSurface(TurnedTee(1.5, 4.0), AutomaticThickness());
  const auto    isRim = [](const Vector3 & point) {
    const Vector3 p = TurnedFrame.ToLocal(point);
    return std::max(std::abs(p[0]), std::abs(p[1])) > HalfWidth - 7.0 || p[2] > 18.0 - 7.0;
  };
  const auto isJunction = [](const Vector3 & point) { return DistanceToTeeAxis(point) < 7.0; };
  const auto quality = MeasureQuality(surface, isRim, isJunction);
  EXPECT_EQ(quality.boundarySides, 0u);
  EXPECT_EQ(quality.nonManifoldSides, 0u);
  EXPECT_LE(MeanDistance(surface, DistanceToTee, [&](const Vector3 & p) { return !isJunction(p); }), Goal);
  ExpectGoodTriangles(quality);
}

TEST(MedialVoxelSurfaceQuality, AGyroidEndsAtTheFacesOfTheImageAlone)
{
  const Surface surface = MakeSurface(GyroidWall(), 3.0);
  const auto    quality = MeasureQuality(surface, IsAtFaceOfGyroid, Nowhere);
  EXPECT_EQ(quality.boundarySides, 0u);
  EXPECT_EQ(quality.nonManifoldSides, 0u);
  EXPECT_LE(MeanDistance(surface, DistanceToGyroid, Everywhere), Goal);
  ExpectGoodTriangles(quality);
}

TEST(MedialVoxelSurfaceQuality, NoiseMakesNoHoles)
{
  const Surface noisyShell = MakeSurface(Flipped(Shell(), 1), 5.0);
  EXPECT_EQ(MeasureQuality(noisyShell, Nowhere, Everywhere).boundarySides, 0u);
  EXPECT_LE(MeanDistance(noisyShell, DistanceToShell, Everywhere), 0.15);

  const Surface noisyPlate = MakeSurface(Flipped(TurnedPlate(), 2), 5.0);
  EXPECT_EQ(MeasureQuality(noisyPlate, IsRimOfPlate, Everywhere).boundarySides, 0u);
  EXPECT_LE(MeanDistance(noisyPlate, DistanceToPlate, Everywhere), 0.15);
}

TEST(MedialVoxelSurfaceQuality, UnequalSpacingIsMeasuredInItsUnits)
{
  const Vector3 spacing{ { 0.4, 0.5, 0.7 } };
  const Vector3 center{ { 14.1, 14.3, 14.2 } };
  const auto    distance = [&](const Vector3 & point) {
    const Vector3 r{ { point[0] - center[0], point[1] - center[1], point[2] - center[2] } };
    return std::abs(std::sqrt(Dot(r, r)) - 11.0);
  };
  const Volume  volume = MakeVolume({ { 72, 58, 42 } }, spacing, [&](const Index3 & v) {
    return distance({ { v[0] * spacing[0], v[1] * spacing[1], v[2] * spacing[2] } }) <= 1.0;
  });
  const Surface surface = MakeSurface(volume, 1.5);
  const auto    quality = MeasureQuality(surface, Nowhere, Nowhere);
  EXPECT_EQ(quality.boundarySides, 0u);
  EXPECT_EQ(quality.nonManifoldSides, 0u);
  EXPECT_EQ(quality.pieces, 1u);
  EXPECT_LE(MeanDistance(surface, distance, Everywhere), Goal * (spacing[0] + spacing[1] + spacing[2]) / 3.0);
  double thickness = 0.0;
  for (const auto & vertex : surface.vertices)
  {
    thickness += vertex.thickness / static_cast<double>(surface.vertices.size());
  }
  EXPECT_NEAR(thickness, 2.0, 0.2 * spacing[1]);
}
