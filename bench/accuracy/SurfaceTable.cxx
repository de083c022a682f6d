// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "AccuracyTables.h"

#include "MedialVoxelTestSurfaceObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

using namespace MedialVoxelTest;

namespace
{
/** A row for a fixed thickness and one for the automatic one. */
void
PrintRows(const std::string &                            name,
          const Volume &                                 volume,
          double                                         tau,
          const std::function<double(const Vector3 &)> & distance,
          const PointTest &                              mayEnd,
          const PointTest &                              mayMeet)
{
  for (const bool isAutomatic : { false, true })
  {
    const Surface surface = isAutomatic ? MakeSurface(volume, AutomaticThickness()) : MakeSurface(volume, tau);
    const auto    quality = MeasureQuality(surface, mayEnd, mayMeet);
    ASSERT_FALSE(surface.vertices.empty()) << name;
    std::vector<double> distances;
    for (const auto & vertex : surface.vertices)
    {
      distances.push_back(distance(vertex.point));
    }
    std::sort(distances.begin(), distances.end());
    std::printf("| %s | %s | %zu | %.3f | %.2f | %.1f° | %zu | %zu |\n",
                name.c_str(),
                isAutomatic ? "auto" : std::to_string(static_cast<int>(tau)).c_str(),
                surface.quads.size(),
                MeanDistance(surface, distance, Everywhere),
                distances[distances.size() * 95 / 100],
                quality.AngleOfOneInHundred(),
                quality.boundarySides,
                quality.nonManifoldSides);
  }
}
} // namespace

void
PrintSurfaceTable()
{
  std::printf("| object | tau | faces | mean | 95 %% | angle | ends | meetings |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  PrintRows("shell, radius 24, wall 4", Shell(), 3.0, DistanceToShell, Nowhere, Nowhere);
  PrintRows("plate, wall 4, turned about all axes", TurnedPlate(), 5.0, DistanceToPlate, IsRimOfPlate, Nowhere);
  for (const double rib : { 4.0, 2.0, 8.0 })
  {
    const double widest = std::max(rib / 2.0, HalfThickness);
    const auto   mayEnd = [widest](const Vector3 & point) {
      const Vector3 p = TurnedFrame.ToLocal(point);
      return std::max(std::abs(p[0]), std::abs(p[1])) > HalfWidth - widest - 3.0 || p[2] > 18.0 - widest - 3.0;
    };
    PrintRows("T, " + std::to_string(static_cast<int>(rib)) + " on 4, turned",
              TurnedTee(HalfThickness, rib / 2.0),
              5.0,
              DistanceToTee,
              mayEnd,
              IsJunctionOfTee);
  }
  PrintRows("gyroid 84³, period 64", GyroidWall(), 3.0, DistanceToGyroid, IsAtFaceOfGyroid, Nowhere);
  PrintRows("shell, flips", Flipped(Shell(), 1), 5.0, DistanceToShell, Nowhere, Nowhere);
  PrintRows("plate, flips", Flipped(TurnedPlate(), 2), 5.0, DistanceToPlate, IsRimOfPlate, Nowhere);
  PrintRows("gyroid, flips", Flipped(GyroidWall(), 3), 5.0, DistanceToGyroid, IsAtFaceOfGyroid, Nowhere);
}
