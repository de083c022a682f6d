// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestSheets_h
#define MedialVoxelTestSheets_h

// How good the sheet of a part is: all of it, wall by wall, and at rims.

#include "itkMedialVoxelBoundary.h"
#include "itkMedialVoxelClassifier.h"

#include "MedialVoxelTestHoles.h"
#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestParameters.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace MedialVoxelTest
{
/** Farther from the mid-surface than this a medial cell is spurious, and a point of it is not covered. */
constexpr double Far = 1.5;

/** What a sheet is worth, in percent of its cells and of the points that it must cover. */
struct Quality
{
  double      spurious;
  double      uncovered;
  std::size_t cells;
};

inline std::vector<unsigned char>
Classify(const Volume & volume, const itk::MedialVoxelParameters & parameters)
{
  const itk::MedialVoxelGrid grid = GridOf(volume);
  const itk::MedialVoxelBox  image = grid.GetVoxelBox();
  const auto                 object = ObjectBits(volume, image);
  itk::MedialVoxelBits       sites(image);
  itk::MedialVoxelComputeBoundary(object, image, itk::MedialVoxelBoundary::Background, image, sites);
  const itk::MedialVoxelFeatureTransform      transform(grid);
  itk::MedialVoxelFeatureTransform::Workspace transformWorkspace;
  itk::MedialVoxelFeatures                    features;
  EXPECT_TRUE(transform.Compute({ &object, &sites }, image, transformWorkspace, features).IsEmpty());
  const itk::MedialVoxelClassifier      classifier(grid, parameters);
  const itk::MedialVoxelNoProgress      progress;
  itk::MedialVoxelClassifier::Workspace workspace;
  std::vector<unsigned char>            labels;
  itk::MedialVoxelCounts                counts;
  EXPECT_TRUE(classifier.Classify({ &object, &sites }, image, features, progress, workspace, labels, counts).IsEmpty());
  return labels;
}

/** Medial cells by their centers, and what they cover. */
struct Sheet
{
  std::vector<Vector3> cells;
  std::vector<double>  gaps; ///< from each sample of the part to the nearest cell; WideGap where none is nearer
};

/** A gap that is no longer measured. */
constexpr double WideGap = 2.0;

inline double
GapAt(const Part & part, const Volume & volume, const std::vector<unsigned char> & labels, const Vector3 & place)
{
  const Vector3 center = CenterOf(part);
  Index3        lower;
  for (int axis = 0; axis < 3; ++axis)
  {
    lower[axis] = static_cast<int>(std::floor(place[axis] + center[axis] - 0.5)) - 1;
  }
  double gap = WideGap;
  for (int move = 0; move < 64; ++move)
  {
    const Index3 v{ { lower[0] + move % 4, lower[1] + move / 4 % 4, lower[2] + move / 16 } };
    if (volume.Contains(v) && labels[volume.Offset(v)] >= itk::MedialVoxelLabel::MedialByBound)
    {
      const Vector3 cell = PositionIn(part, { { v[0] + 0.5, v[1] + 0.5, v[2] + 0.5 } });
      gap = std::min(gap, std::hypot(cell[0] - place[0], cell[1] - place[1], cell[2] - place[2]));
    }
  }
  return gap;
}

inline Sheet
SheetOf(const Part & part, const Volume & volume, const std::vector<unsigned char> & labels)
{
  Sheet sheet;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] >= itk::MedialVoxelLabel::MedialByBound)
    {
      const Index3 v = volume.IndexAt(i);
      sheet.cells.push_back(PositionIn(part, { { v[0] + 0.5, v[1] + 0.5, v[2] + 0.5 } }));
    }
  }
  for (const SheetPoint & sample : part.samples)
  {
    sheet.gaps.push_back(GapAt(part, volume, labels, sample.place));
  }
  return sheet;
}

inline double
Percent(std::size_t count, std::size_t all)
{
  return 100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, all));
}

inline Quality
Judge(const Part & part, const Volume & volume, const std::vector<unsigned char> & labels)
{
  const Sheet sheet = SheetOf(part, volume, labels);
  const auto  spurious =
    std::count_if(sheet.cells.begin(), sheet.cells.end(), [&](const Vector3 & p) { return part.middle(p) > Far; });
  const auto uncovered = std::count_if(sheet.gaps.begin(), sheet.gaps.end(), [](double gap) { return gap > Far; });
  return { Percent(static_cast<std::size_t>(spurious), sheet.cells.size()),
           Percent(static_cast<std::size_t>(uncovered), sheet.gaps.size()),
           sheet.cells.size() };
}

inline Quality
Judge(const Part & part, const Volume & volume, const itk::MedialVoxelParameters & parameters)
{
  return Judge(part, volume, Classify(volume, parameters));
}

inline Quality
Judge(const Part & part, Noise noise, const itk::MedialVoxelParameters & parameters)
{
  return Judge(part, Voxelize(part, noise, 77), parameters);
}

/** What the sheet of the walls of one thickness is worth, in numbers of cells and of points that it must cover. */
struct WallQuality
{
  std::size_t cells;
  std::size_t spurious;
  std::size_t points;
  std::size_t uncovered;
  std::size_t farUncovered;     ///< no cell nearer than WideGap
  std::size_t pierced;          ///< a hole through the wall lies within PiercedRadius
  std::size_t uncoveredPierced; ///< both
};

/** Reaches beyond walls of up to 4 voxels, whose holes it can see; thicker ones have none. */
constexpr double PiercedRadius = 2.5;

inline std::map<double, WallQuality>
JudgeWalls(const Part & part, const Volume & volume, const std::vector<unsigned char> & labels)
{
  const Sheet                   sheet = SheetOf(part, volume, labels);
  std::map<double, WallQuality> walls;
  for (const Vector3 & cell : sheet.cells)
  {
    const SheetPoint * nearest = nullptr;
    double             least = std::numeric_limits<double>::infinity();
    for (const SheetPoint & sample : part.samples)
    {
      const Vector3 way{ { sample.place[0] - cell[0], sample.place[1] - cell[1], sample.place[2] - cell[2] } };
      const double  distance = Dot(way, way);
      nearest = distance < least ? &sample : nearest;
      least = std::min(distance, least);
    }
    WallQuality & wall = walls[nearest->wall];
    ++wall.cells;
    wall.spurious += part.middle(cell) > Far ? 1 : 0;
  }
  for (std::size_t k = 0; k < sheet.gaps.size(); ++k)
  {
    WallQuality & wall = walls[part.samples[k].wall];
    const bool    isPierced =
      part.samples[k].wall < 2.0 * PiercedRadius && IsPierced(part, volume, part.samples[k].place, PiercedRadius);
    ++wall.points;
    wall.uncovered += sheet.gaps[k] > Far ? 1 : 0;
    wall.farUncovered += sheet.gaps[k] >= WideGap ? 1 : 0;
    wall.pierced += isPierced ? 1 : 0;
    wall.uncoveredPierced += isPierced && sheet.gaps[k] > Far ? 1 : 0;
  }
  return walls;
}

/** Where the sheet begins at rims, against where the medial axis of a square rim does; in voxels, positive further in.
 */
struct RimQuality
{
  double      mean;
  double      worst;
  std::size_t strips;
};

inline RimQuality
JudgeRims(const Part & part, const Volume & volume, const std::vector<unsigned char> & labels)
{
  // A sheet that has not begun so far behind the axis counts as if it began there.
  constexpr double    most = 8.0;
  std::vector<double> lateness(part.rims.size(), most);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] < itk::MedialVoxelLabel::MedialByBound)
    {
      continue;
    }
    const Index3  v = volume.IndexAt(i);
    const Vector3 cell = Turned(PositionIn(part, { { v[0] + 0.5, v[1] + 0.5, v[2] + 0.5 } }));
    for (std::size_t k = 0; k < part.rims.size(); ++k)
    {
      const RimStrip & strip = part.rims[k];
      const double     depth = strip.sign * (cell[strip.inward] - strip.edge[strip.inward]);
      if (std::abs(cell[strip.along] - strip.edge[strip.along]) <= 0.5 &&
          std::abs(cell[strip.across] - strip.edge[strip.across]) <= Far && depth >= 0.0)
      {
        lateness[k] = std::min(lateness[k], depth - strip.half);
      }
    }
  }
  RimQuality quality{ 0.0, 0.0, lateness.size() };
  for (const double late : lateness)
  {
    quality.mean += late / static_cast<double>(lateness.size());
    quality.worst = std::abs(late) > std::abs(quality.worst) ? late : quality.worst;
  }
  return quality;
}

/** The part with the rims of its walls of one thickness alone. */
inline Part
WithRimsOf(Part part, double thickness)
{
  const auto isOther = [thickness](const RimStrip & strip) { return 2.0 * strip.half != thickness; };
  part.rims.erase(std::remove_if(part.rims.begin(), part.rims.end(), isOther), part.rims.end());
  return part;
}

/** Thicknesses of the walls that have rims. */
inline std::set<double>
WallsOf(const Part & part)
{
  std::set<double> walls;
  for (const RimStrip & strip : part.rims)
  {
    walls.insert(2.0 * strip.half);
  }
  return walls;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestSheets_h
