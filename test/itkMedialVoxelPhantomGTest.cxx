// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// What the medial cells of known shapes look like (invariant I7).

#include "MedialVoxelTestRuns.h"

namespace
{
using namespace MedialVoxelTest;

/** Medial cells of a volume with their centers, in voxel units. */
struct MedialCells
{
  Index3                     size;
  std::vector<unsigned char> labels;
  std::vector<Vector3>       centers;

  explicit MedialCells(const Volume & volume, double thickness)
    : size(volume.size)
    , labels(RunMedialFilter<3>(volume, thickness).labels)
  {
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      if (labels[i] >= 2)
      {
        const Index3 cell = volume.IndexAt(i);
        centers.push_back({ { cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5 } });
      }
    }
  }

  bool
  IsMedialAt(const Vector3 & point) const
  {
    Index3 cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = static_cast<int>(std::floor(point[axis]));
      if (cell[axis] < 0 || cell[axis] >= size[axis])
      {
        return false;
      }
    }
    return labels[(static_cast<std::size_t>(cell[2]) * size[1] + cell[1]) * size[0] + cell[0]] >= 2;
  }

  /** Whether a segment of this direction around a point meets a medial cell. */
  bool
  IsMetBy(const Vector3 & point, const Vector3 & unitDirection, double reach) const
  {
    for (double t = -reach; t <= reach; t += 0.01)
    {
      if (this->IsMedialAt(
            { { point[0] + t * unitDirection[0], point[1] + t * unitDirection[1], point[2] + t * unitDirection[2] } }))
      {
        return true;
      }
    }
    return false;
  }
};

struct Deviation
{
  double      mean{ 0.0 };
  double      maximum{ 0.0 };
  std::size_t cells{ 0 };
};

Deviation
DeviationOf(const std::vector<double> & distances)
{
  Deviation d;
  for (const double distance : distances)
  {
    d.mean += distance / static_cast<double>(distances.size());
    d.maximum = std::max(d.maximum, distance);
  }
  d.cells = distances.size();
  return d;
}

/** Evenly spread directions (a Fibonacci sphere). */
std::vector<Vector3>
Directions(int count)
{
  std::vector<Vector3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - z * z);
    const double phi = i * 2.399963229728653;
    directions.push_back({ { r * std::cos(phi), r * std::sin(phi), z } });
  }
  return directions;
}

/** Tau 3 below 6 voxels of wall, tau 5 from there on. */
double
ThicknessFor(double wall)
{
  return wall < 6.0 ? 3.0 : 5.0;
}
} // namespace

TEST(MedialVoxelPhantom, PlatesAcrossTheImageHaveOneCellPerColumn)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int wall = 1; wall <= 8; ++wall)
    {
      for (const double thickness : { 2.0, 3.0, 5.0 })
      {
        SCOPED_TRACE("axis " + std::to_string(axis) + ", wall " + std::to_string(wall));
        Index3 size{ { 9, 10, 11 } };
        size[axis] = 16;
        const Volume          plate = AxisPlate(size, UnitSpacing, axis, 4, wall);
        const auto            labels = RunMedialFilter<3>(plate, thickness).labels;
        std::map<Index3, int> perColumn;
        for (std::size_t i = 0; i < labels.size(); ++i)
        {
          Index3       column = plate.IndexAt(i);
          const double offMiddle = std::abs(column[axis] + 0.5 - (4 + (wall - 1) / 2.0));
          column[axis] = 0;
          if (IsCell(plate, plate.IndexAt(i)))
          {
            perColumn[column] += labels[i] >= 2 ? 1 : 0;
          }
          EXPECT_TRUE(labels[i] < 2 || offMiddle <= (wall % 2 == 1 ? 0.5 : 0.0)) << "cell " << i;
        }
        const auto columns = plate.object.size() / size[axis];
        const auto last = static_cast<std::size_t>(size[(axis + 1) % 3] + size[(axis + 2) % 3] - 1);
        EXPECT_EQ(perColumn.size(), columns - last);
        for (const auto & column : perColumn)
        {
          EXPECT_EQ(column.second, 1);
        }
      }
    }
  }
}

TEST(MedialVoxelPhantom, PlatesOfUnequalSpacingHaveOneCellPerColumn)
{
  for (int wall = 1; wall <= 8; ++wall)
  {
    const Volume plate = AxisPlate({ { 8, 9, 16 } }, { { 0.9570312, 0.9570312, 1.5 } }, 2, 4, wall);
    const auto   run = RunMedialFilter<3>(plate, 3.0);
    EXPECT_EQ(run.counts.boundCells + run.counts.geodesicMedialCells, 7u * 8u) << wall;
  }
}

TEST(MedialVoxelPhantom, TiltedPlatesFollowTheMiddlePlane)
{
  const Index3  size{ { 36, 36, 36 } };
  const Vector3 center{ { 17.3, 17.6, 17.1 } };
  for (const Vector3 & normal : { Vector3{ { 1, 2, 5 } }, Vector3{ { 1, 1, 1 } }, Vector3{ { 3, 0, 4 } } })
  {
    const double  length = std::sqrt(Dot(normal, normal));
    const Vector3 unit{ { normal[0] / length, normal[1] / length, normal[2] / length } };
    for (const double wall : { 1.8, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0 })
    {
      SCOPED_TRACE("normal z " + std::to_string(unit[2]) + ", wall " + std::to_string(wall));
      const MedialCells   cells(TiltedPlate(size, center, normal, wall), ThicknessFor(wall));
      const double        rim = wall + 2.0;
      std::vector<double> distances;
      for (const Vector3 & p : cells.centers)
      {
        const bool inside = std::all_of(p.begin(), p.end(), [&](double x) { return x > rim && x < 35 - rim; });
        if (inside)
        {
          distances.push_back(std::abs(Dot(p, unit) - Dot(center, unit)));
        }
      }
      const Deviation d = DeviationOf(distances);
      EXPECT_GT(d.cells, 100u);
      EXPECT_LT(d.mean, 0.55);
      EXPECT_LT(d.maximum, 1.2);

      int holes = 0;
      int probes = 0;
      for (double x = rim; x < 35 - rim; x += 0.37)
      {
        for (double y = rim; y < 35 - rim; y += 0.41)
        {
          const Vector3 p{ { x, y, (Dot(center, normal) - normal[0] * x - normal[1] * y) / normal[2] } };
          if (p[2] > rim && p[2] < 35 - rim)
          {
            ++probes;
            holes += cells.IsMetBy(p, unit, 1.5) ? 0 : 1;
          }
        }
      }
      EXPECT_GT(probes, 100);
      EXPECT_EQ(holes, 0);
    }
  }
}

TEST(MedialVoxelPhantom, ShellsFollowTheMiddleSphere)
{
  const double  radius = 15.0;
  const Vector3 center{ { 21.2, 20.9, 21.4 } };
  for (const double wall : { 2.0, 3.0, 4.0, 5.0, 6.0, 8.0 })
  {
    SCOPED_TRACE("wall " + std::to_string(wall));
    const MedialCells   cells(SphericalShell({ { 43, 43, 43 } }, center, radius, wall), ThicknessFor(wall));
    std::vector<double> distances;
    for (const Vector3 & p : cells.centers)
    {
      const Vector3 r{ { p[0] - center[0], p[1] - center[1], p[2] - center[2] } };
      distances.push_back(std::abs(std::sqrt(Dot(r, r)) - radius));
    }
    const Deviation d = DeviationOf(distances);
    const double    area = 4.0 * 3.14159265358979323846 * radius * radius;
    EXPECT_NEAR(static_cast<double>(d.cells) / area, 1.5, 0.08);
    EXPECT_LT(d.mean, 0.55);
    EXPECT_LT(d.maximum, 1.25);

    int holes = 0;
    for (const Vector3 & u : Directions(4000))
    {
      const Vector3 p{ { center[0] + radius * u[0], center[1] + radius * u[1], center[2] + radius * u[2] } };
      holes += cells.IsMetBy(p, u, 1.5) ? 0 : 1;
    }
    EXPECT_LE(holes, wall < 3.0 ? 1 : 0); // one ray of 4000 may slip through a wall of 2 voxels
  }
}

TEST(MedialVoxelPhantom, JunctionsKeepTheirSheets)
{
  for (const int wall : { 2, 3, 4 })
  {
    SCOPED_TRACE("wall " + std::to_string(wall));
    const Index3      size{ { 33, 8, 28 } };
    const int         base = 5;
    const MedialCells tee(TeeJunction(size, base, wall), 3.0);
    const MedialCells ell(EllJunction(size, base, wall), 3.0);
    const double      middle = base + (wall - 1) / 2.0;
    const double      web = (size[0] - wall) / 2 + (wall - 1) / 2.0;
    for (int y = 0; y < size[1] - 1; ++y)
    {
      // Columns further than one wall thickness from the junction cross exactly one medial cell.
      for (int x = 0; x < size[0] - 1; ++x)
      {
        int teeCells = 0;
        int ellCells = 0;
        for (int z = 0; z < size[2] - 1; ++z)
        {
          teeCells += tee.IsMedialAt({ { x + 0.5, y + 0.5, z + 0.5 } }) ? 1 : 0;
          ellCells += ell.IsMedialAt({ { x + 0.5, y + 0.5, z + 0.5 } }) ? 1 : 0;
        }
        EXPECT_TRUE(std::abs(x + 0.5 - web) <= 1.5 * wall || teeCells == 1) << "tee, column " << x;
        EXPECT_TRUE(x + 0.5 < base + 2.0 * wall || ellCells == 1) << "ell, column " << x;
      }
      for (int z = base + 2 * wall; z < size[2] - 1; ++z)
      {
        int rowCells = 0;
        for (int x = 0; x < size[0] - 1; ++x)
        {
          rowCells += tee.IsMedialAt({ { x + 0.5, y + 0.5, z + 0.5 } }) ? 1 : 0;
        }
        EXPECT_EQ(rowCells, 1) << "tee, row " << z;
      }
    }
    for (const Vector3 & p : tee.centers)
    {
      EXPECT_LE(std::min(std::abs(p[2] - middle), std::abs(p[0] - web)), 1.0);
    }
  }
}
