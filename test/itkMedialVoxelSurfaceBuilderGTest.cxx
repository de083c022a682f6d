// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSurfaceBuilder.h"

#include "MedialVoxelTestSurface.h"
#include "MedialVoxelTestSurfaceOracle.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

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

/** A mesh by brute force, from the edges that the vertices of cells name. */
struct WholeMesh
{
  std::vector<Cell>                                  vertices;
  std::vector<std::array<std::size_t, 4>>            faces; // round the voxel edge, from the highest cell on
  std::map<std::pair<std::size_t, std::size_t>, int> sides;

  /** The mesh of these vertices; without fins and scraps: that of those that are left. */
  explicit WholeMesh(const std::vector<Cell> & cells, bool isTrimmed = false)
    : vertices(cells)
  {
    std::map<std::pair<Index3, unsigned int>, std::size_t> vertexAt;
    std::set<Index3>                                       inOrder;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      for (unsigned int edge = 0; edge < Topology::NumberOfEdges; ++edge)
      {
        if ((cells[i].quads >> edge & 1) != 0)
        {
          vertexAt[{ IndexOf(cells[i]), edge }] = i;
        }
      }
      inOrder.insert({ { cells[i].index[2], cells[i].index[1], cells[i].index[0] } });
    }
    for (const Index3 & zyx : inOrder)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const Index3 voxel{ { zyx[2], zyx[1], zyx[0] } };
        if (vertexAt.count({ voxel, 4 * axis }) > 0)
        {
          const auto                    around = SurfaceOracle::CellsAround({ voxel, static_cast<int>(axis) });
          const std::array<unsigned, 4> numbers{ { 4 * axis, 4 * axis + 1, 4 * axis + 3, 4 * axis + 2 } };
          std::array<std::size_t, 4>    face{};
          for (int corner = 0; corner < 4; ++corner)
          {
            face[corner] = vertexAt.at({ around[corner], numbers[corner] });
          }
          faces.push_back(face);
          for (int side = 0; side < 4; ++side)
          {
            ++sides[std::minmax(face[side], face[(side + 1) % 4])];
          }
          faceEdges.push_back({ { 4 * axis, 4 * axis + 1, 4 * axis + 3, 4 * axis + 2 } });
        }
      }
    }
    if (!isTrimmed)
    {
      *this = WholeMesh(this->Trimmed(), true);
    }
  }

  static Index3
  IndexOf(const Cell & cell)
  {
    return { { cell.index[0], cell.index[1], cell.index[2] } };
  }

private:
  std::vector<Cell>
  Trimmed() const
  {
    std::map<Index3, int> verticesIn;
    for (const Cell & vertex : vertices)
    {
      ++verticesIn[IndexOf(vertex)];
    }
    std::vector<Cell> left = vertices;
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      int  rims = 0;
      int  pairs = 0;
      bool touches = false;
      for (int side = 0; side < 4; ++side)
      {
        const int number = sides.at(std::minmax(faces[i][side], faces[i][(side + 1) % 4]));
        rims += number == 1 ? 1 : 0;
        pairs += number == 2 ? 1 : 0;
        touches = touches || verticesIn.at(IndexOf(vertices[faces[i][side]])) > 1;
      }
      for (int corner = 0; corner < 4 && (rims == 4 ? touches : rims == 3 && pairs == 0); ++corner)
      {
        Cell & vertex = left[faces[i][corner]];
        vertex.quads = static_cast<Topology::EdgeMask>(vertex.quads & ~(1u << faceEdges[i][corner]));
      }
    }
    left.erase(std::remove_if(left.begin(), left.end(), [](const Cell & cell) { return cell.quads == 0; }), left.end());
    std::sort(left.begin(), left.end(), IsBefore);
    return left;
  }

  std::vector<std::array<unsigned int, 4>> faceEdges; // the number of the voxel edge in the cell of each corner
};

/** Five steps of the smoothing, by its definition, on the whole mesh at once. */
std::vector<Vector3>
SmoothedPoints(const WholeMesh & mesh, const Vector3 & spacing)
{
  const std::vector<Cell> & cells = mesh.vertices;
  std::vector<Vector3>      points;
  for (const Cell & cell : cells)
  {
    Vector3 point;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = (cell.index[axis] + 0.5) * spacing[axis] + cell.offset[axis];
    }
    points.push_back(point);
  }
  std::vector<std::vector<std::pair<std::size_t, int>>> neighbors(cells.size());
  for (const auto & side : mesh.sides)
  {
    const auto & [a, b] = side.first;
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
  const auto    mesh = WholeMesh(cells);
  const Surface surface = MakeSurface(volume, 3.0);
  EXPECT_LT(mesh.vertices.size(), cells.size()) << "nothing is trimmed";
  ASSERT_EQ(surface.vertices.size(), mesh.vertices.size());
  ASSERT_EQ(surface.quads.size(), mesh.faces.size());
  ASSERT_GT(surface.quads.size(), 900u);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
  {
    EXPECT_EQ(surface.vertices[i].thickness, mesh.vertices[i].thickness);
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
  {
    // From the lowest cell on, to either side.
    const auto & face = mesh.faces[i];
    const auto & quad = surface.quads[i].vertices;
    EXPECT_EQ(*std::min_element(quad.begin(), quad.end()), quad[0]);
    EXPECT_EQ(quad[0], face[2]);
    EXPECT_EQ(quad[2], face[0]);
    EXPECT_EQ(std::minmax(quad[1], quad[3]), std::minmax<std::uint64_t>(face[1], face[3]));
  }
}

TEST(MedialVoxelSurfaceBuilder, SmoothsAsOnTheWholeMesh)
{
  const Volume  volume = TestVolume();
  const auto    expected = SmoothedPoints(WholeMesh(SortedCells(volume, 3.0)), volume.spacing);
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

TEST(MedialVoxelSurfaceBuilder, BatchesAndTheOrderOfTasksChangeNothing)
{
  const Volume  volume = TestVolume();
  const auto    cells = SortedCells(volume, 3.0);
  const Surface alone = MakeSurface(volume, 3.0);
  for (const std::size_t verticesOfBatch : { 1u, 50u, 700u, 1u << 17 })
  {
    Surface surface;
    FillSurface(PlacementOf(volume), volume.spacing, cells, surface, verticesOfBatch);
    ASSERT_EQ(surface.vertices.size(), alone.vertices.size());
    ASSERT_EQ(surface.quads.size(), alone.quads.size());
    for (std::size_t i = 0; i < alone.vertices.size(); ++i)
    {
      EXPECT_EQ(surface.vertices[i].point, alone.vertices[i].point);
      EXPECT_EQ(surface.vertices[i].thickness, alone.vertices[i].thickness);
    }
    for (std::size_t i = 0; i < alone.quads.size(); ++i)
    {
      EXPECT_EQ(surface.quads[i].vertices, alone.quads[i].vertices);
      EXPECT_EQ(surface.quads[i].areas, alone.quads[i].areas);
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
  const Volume                     volume = TestVolume();
  const Surface                    plain = MakeSurface(volume, 3.0);
  itk::MedialVoxelSurfacePlacement placement;
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
