// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSurfaceBuilder.h"

#include "MedialVoxelTestSurface.h"

#include <gtest/gtest.h>

#include <map>

namespace
{
using namespace MedialVoxelTest;
using Cell = itk::MedialVoxelSurfaceCell;
using Topology = itk::MedialVoxelSurfaceTopology;

std::vector<Cell>
SortedCells(const Volume & volume, double tau)
{
  std::vector<Cell>         cells;
  const itk::MedialVoxelBox whole = GridOf(volume).GetVoxelBox();
  EXPECT_TRUE(FindSurfaceCells(volume, FixedThickness(tau), whole, whole, cells).IsEmpty());
  return cells;
}

/** Voxel edges with a quadrilateral, by lower voxel and axis, in the order of the faces. */
std::vector<std::pair<Index3, int>>
QuadEdges(const std::vector<Cell> & cells)
{
  std::vector<std::pair<Index3, int>> edges;
  for (const Cell & cell : cells)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((cell.quads >> (4 * axis) & 1) != 0)
      {
        edges.push_back({ { { cell.index[0], cell.index[1], cell.index[2] } }, axis });
      }
    }
  }
  return edges;
}

/** The mesh as a graph: for each side the number of quadrilaterals, from the voxel edges alone. */
std::map<std::pair<Index3, Index3>, int>
SidesOf(const std::vector<std::pair<Index3, int>> & edges)
{
  std::map<std::pair<Index3, Index3>, int> sides;
  for (const auto & edge : edges)
  {
    Index3 next{};
    Index3 after{};
    next[(edge.second + 1) % 3] = 1;
    after[(edge.second + 2) % 3] = 1;
    const auto at = [&](int u, int v) {
      Index3 cell = edge.first;
      for (int axis = 0; axis < 3; ++axis)
      {
        cell[axis] -= u * next[axis] + v * after[axis];
      }
      return cell;
    };
    const Index3 ring[4] = { at(0, 0), at(1, 0), at(1, 1), at(0, 1) };
    for (int side = 0; side < 4; ++side)
    {
      ++sides[std::minmax(ring[side], ring[(side + 1) % 4])];
    }
  }
  return sides;
}

/** Five steps of the smoothing, by its definition, on the whole mesh at once. */
std::vector<Vector3>
SmoothedPoints(const std::vector<Cell> & cells, const Vector3 & spacing)
{
  std::map<Index3, std::size_t> vertexAt;
  std::vector<Vector3>          points;
  for (const Cell & cell : cells)
  {
    vertexAt[{ { cell.index[0], cell.index[1], cell.index[2] } }] = points.size();
    Vector3 point;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = (cell.index[axis] + 0.5) * spacing[axis] + cell.offset[axis];
    }
    points.push_back(point);
  }
  std::vector<std::vector<std::pair<std::size_t, int>>> neighbors(cells.size());
  for (const auto & side : SidesOf(QuadEdges(cells)))
  {
    const auto a = vertexAt.at(side.first.first);
    const auto b = vertexAt.at(side.first.second);
    neighbors[a].push_back({ b, side.second });
    neighbors[b].push_back({ a, side.second });
  }
  for (int step = 0; step < 5; ++step)
  {
    const std::vector<Vector3> before = points;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto has = [&](auto && test) { return std::any_of(neighbors[i].begin(), neighbors[i].end(), test); };
      const bool atRim = has([](const auto & n) { return n.second == 1; });
      const bool atJunction = has([](const auto & n) { return n.second > 2; });
      Vector3    sum{};
      int        number = 0;
      for (const auto & neighbor : neighbors[i])
      {
        if ((!atRim || neighbor.second == 1) && (!atJunction || neighbor.second > 2))
        {
          for (int axis = 0; axis < 3; ++axis)
          {
            sum[axis] += before[neighbor.first][axis];
          }
          ++number;
        }
      }
      double toPlane = cells[i].distance;
      for (int axis = 0; axis < 3; ++axis)
      {
        points[i][axis] += number > 0 ? 0.6 * (sum[axis] / number - before[i][axis]) : 0.0;
        toPlane -= cells[i].normal[axis] * (points[i][axis] - (cells[i].index[axis] + 0.5) * spacing[axis]);
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        points[i][axis] += 0.15 * toPlane * cells[i].normal[axis];
      }
    }
  }
  return points;
}

Volume
TestVolume()
{
  return RandomBoxes({ { 40, 25, 31 } }, { { 1.0, 1.2, 0.8 } }, 25, 641);
}
} // namespace

TEST(MedialVoxelSurfaceTopology, DirectionsFollowRimsAndJunctions)
{
  // One quadrilateral: its two sides at this cell are a rim.
  EXPECT_EQ(Topology::DirectionsToFollow(1u << Topology::EdgeOf(2, 0, 0)), 0b000101);
  // A plane across z: four quadrilaterals, four neighbors.
  EXPECT_EQ(Topology::DirectionsToFollow(0xFu << Topology::EdgeOf(2, 0, 0)), 0b001111);
  // With half a plane across x on top of it: three meet along y.
  const unsigned int half = 1u << Topology::EdgeOf(0, 0, 1) | 1u << Topology::EdgeOf(0, 1, 1);
  EXPECT_EQ(Topology::QuadsTowards(static_cast<Topology::EdgeMask>(0xF00u | half), 3), 3u);
  EXPECT_EQ(Topology::DirectionsToFollow(static_cast<Topology::EdgeMask>(0xF00u | half)), 0b001100);
  // A junction that ends at a rim stays.
  const unsigned int quarter = 1u << Topology::EdgeOf(0, 0, 1);
  EXPECT_EQ(Topology::DirectionsToFollow(static_cast<Topology::EdgeMask>(0xF00u | quarter)), 0);
}

TEST(MedialVoxelSurfaceBuilder, NumbersFollowTheCellsAndFacesTheirEdges)
{
  const Volume  volume = TestVolume();
  const auto    cells = SortedCells(volume, 3.0);
  const auto    edges = QuadEdges(cells);
  const Surface surface = MakeSurface(volume, 3.0);
  ASSERT_EQ(surface.vertices.size(), cells.size());
  ASSERT_EQ(surface.quads.size(), edges.size());
  ASSERT_GT(edges.size(), 900u);
  std::map<Index3, std::size_t> vertexAt;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    vertexAt[{ { cells[i].index[0], cells[i].index[1], cells[i].index[2] } }] = i;
    EXPECT_EQ(surface.vertices[i].thickness, cells[i].thickness);
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const auto & quad = surface.quads[i].vertices;
    EXPECT_EQ(*std::max_element(quad.begin(), quad.end()), vertexAt.at(edges[i].first));
    EXPECT_EQ(*std::min_element(quad.begin(), quad.end()), quad[0]);
  }
}

TEST(MedialVoxelSurfaceBuilder, SmoothsAsOnTheWholeMesh)
{
  const Volume  volume = TestVolume();
  const auto    expected = SmoothedPoints(SortedCells(volume, 3.0), volume.spacing);
  const Surface surface = MakeSurface(volume, 3.0);
  ASSERT_EQ(surface.vertices.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(surface.vertices[i].point[axis], expected[i][axis], 1e-5);
    }
  }
}

TEST(MedialVoxelSurfaceBuilder, SidesSayWhetherTheyAreRimOrJunction)
{
  const Surface surface = MakeSurface(TestVolume(), 3.0);
  const auto    sides = CountSides(surface);
  int           rims = 0;
  int           junctions = 0;
  for (const auto & quad : surface.quads)
  {
    for (int side = 0; side < 4; ++side)
    {
      const int number = sides.at(std::minmax(quad.vertices[side], quad.vertices[(side + 1) % 4]));
      EXPECT_EQ(quad.rimSides >> side & 1, number == 1 ? 1 : 0);
      EXPECT_EQ(quad.junctionSides >> side & 1, number > 2 ? 1 : 0);
      rims += number == 1 ? 1 : 0;
      junctions += number > 2 ? 1 : 0;
    }
  }
  EXPECT_GT(rims, 100);
  EXPECT_GT(junctions, 30);
}

TEST(MedialVoxelSurfaceBuilder, QuadrilateralsOfAWallFaceOneWay)
{
  for (const Vector3 & normal : { Vector3{ { 1.0, -1.0, 0.0 } },
                                  Vector3{ { 1.0, 0.0, 0.0 } },
                                  Vector3{ { 0.0, 0.0, -1.0 } },
                                  Vector3{ { 2.0, 1.0, -1.0 } } })
  {
    const Surface surface = MakeSurface(TiltedPlate({ { 30, 30, 30 } }, { { 14.3, 14.6, 14.4 } }, normal, 4.0), 3.0);
    const double  sign = normal[0] + std::sqrt(2.0) * normal[1] + std::sqrt(3.0) * normal[2] > 0.0 ? 1.0 : -1.0;
    ASSERT_GT(surface.quads.size(), 500u);
    for (const auto & quad : surface.quads)
    {
      for (const auto & t : TrianglesOf(quad))
      {
        EXPECT_GT(
          sign * Dot(normal,
                     Cross(surface.vertices[t[0]].point, surface.vertices[t[1]].point, surface.vertices[t[2]].point)),
          0.0);
      }
    }
  }
}

TEST(MedialVoxelSurfaceBuilder, TrianglesLieAlongTheShorterDiagonal)
{
  const Surface surface = MakeSurface(TestVolume(), 3.0);
  int           splits[2] = { 0, 0 };
  for (const auto & quad : surface.quads)
  {
    for (unsigned int half = 0; half < 2; ++half)
    {
      const auto    t = TrianglesOf(quad)[half];
      const Vector3 normal =
        Cross(surface.vertices[t[0]].point, surface.vertices[t[1]].point, surface.vertices[t[2]].point);
      EXPECT_NEAR(quad.areas[half], 0.5 * std::sqrt(Dot(normal, normal)), 1e-9);
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        EXPECT_EQ(quad.vertices[quad.GetTriangle(half)[corner]], t[corner]);
      }
    }
    const auto squaredLength = [&](int a, int b) {
      const Vector3 & p = surface.vertices[quad.vertices[a]].point;
      const Vector3 & q = surface.vertices[quad.vertices[b]].point;
      const Vector3   d{ { q[0] - p[0], q[1] - p[1], q[2] - p[2] } };
      return Dot(d, d);
    };
    EXPECT_EQ(quad.isSplitAlong13, squaredLength(1, 3) < squaredLength(0, 2));
    ++splits[quad.isSplitAlong13 ? 1 : 0];
  }
  EXPECT_GT(splits[0], 100);
  EXPECT_GT(splits[1], 100);
}

TEST(MedialVoxelSurfaceBuilder, PlacesPointsInSpace)
{
  const Volume                              volume = TestVolume();
  const Surface                             plain = MakeSurface(volume, 3.0);
  itk::MedialVoxelSurfaceBuilder::Placement placement;
  placement.origin = { { 10.0, -20.0, 30.0 } };
  // A quarter turn about z, and z upside down.
  placement.steps[0] = { { 0.0, volume.spacing[0], 0.0 } };
  placement.steps[1] = { { -volume.spacing[1], 0.0, 0.0 } };
  placement.steps[2] = { { 0.0, 0.0, -volume.spacing[2] } };
  Surface turned;
  FillSurface(placement, volume.spacing, SortedCells(volume, 3.0), turned);
  ASSERT_EQ(turned.vertices.size(), plain.vertices.size());
  for (std::size_t i = 0; i < plain.vertices.size(); ++i)
  {
    const Vector3 & p = plain.vertices[i].point;
    EXPECT_NEAR(turned.vertices[i].point[0], 10.0 - p[1], 1e-9);
    EXPECT_NEAR(turned.vertices[i].point[1], -20.0 + p[0], 1e-9);
    EXPECT_NEAR(turned.vertices[i].point[2], 30.0 - p[2], 1e-9);
  }
}

TEST(MedialVoxelSurfaceBuilder, CellsThatDoNotFitTogetherAreRefused)
{
  auto cells = SortedCells(TestVolume(), 3.0);
  cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2));
  Surface surface;
  EXPECT_THROW(FillSurface(PlacementOf(TestVolume()), TestVolume().spacing, cells, surface), std::logic_error);
}
