// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSurfaceCells.h"

#include "MedialVoxelTestAutomatic.h"
#include "MedialVoxelTestSurface.h"
#include "MedialVoxelTestSurfaceOracle.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace
{
using namespace MedialVoxelTest;
using Topology = itk::MedialVoxelSurfaceTopology;

using Edge = SurfaceOracle::Edge;

/** Whether all four cells around an edge exist. */
bool
HasFourCells(const Volume & volume, const Edge & edge)
{
  bool all = true;
  for (int corner = 0; corner < 4; ++corner)
  {
    const Index3 cell =
      Moved(Moved(edge.first, (edge.second + 1) % 3, -(corner & 1)), (edge.second + 2) % 3, -(corner >> 1));
    all = all && volume.Contains(cell) && IsCell(volume, cell);
  }
  return all;
}

/** The definition of a crossed edge to the letter. */
std::set<Edge>
CrossedEdges(const Volume & volume, double tau, PathSums sums = PathSums::Doubles)
{
  Classifier     oracle(volume, tau, sums);
  std::set<Edge> edges;
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Edge   edge{ volume.IndexAt(i), axis };
      const Index3 other = Moved(edge.first, axis, 1);
      if (!volume.Contains(other) || !(volume.IsObject(edge.first) || volume.IsObject(other)))
      {
        continue;
      }
      const long a = oracle.GetNearest()[i];
      const long b = oracle.GetNearest()[volume.Offset(other)];
      if (a >= 0 && b >= 0 && HasFourCells(volume, edge) && oracle.GeodesicDistance(a, b) >= oracle.GetEpsilon())
      {
        edges.insert(edge);
      }
    }
  }
  return edges;
}

/** The edges that a vertex names. */
std::set<Edge>
EdgesOf(const itk::MedialVoxelSurfaceCell & cell)
{
  std::set<Edge> edges;
  for (unsigned int edge = 0; edge < Topology::NumberOfEdges; ++edge)
  {
    if ((cell.quads >> edge & 1) != 0)
    {
      const auto offset = Topology::OffsetOf(edge);
      Index3     voxel;
      for (int axis = 0; axis < 3; ++axis)
      {
        voxel[axis] = cell.index[axis] + static_cast<int>(offset[axis]);
      }
      edges.insert({ voxel, static_cast<int>(Topology::AxisOf(edge)) });
    }
  }
  return edges;
}

/** The edges that the vertices name, with the number of those that name each. */
std::map<Edge, int>
EdgesOf(const std::vector<itk::MedialVoxelSurfaceCell> & cells)
{
  std::map<Edge, int> edges;
  for (const auto & cell : cells)
  {
    for (const Edge & edge : EdgesOf(cell))
    {
      ++edges[edge];
    }
  }
  return edges;
}

/** The largest threshold of the cells around an edge. */
double
EpsilonOf(const Volume & volume, const JointClassifier & oracle, const Edge & edge)
{
  double epsilon = 0.0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const Index3 cell =
      Moved(Moved(edge.first, (edge.second + 1) % 3, -(corner & 1)), (edge.second + 2) % 3, -(corner >> 1));
    epsilon = std::max(epsilon, oracle.EpsilonOf(volume.Offset(cell)));
  }
  return epsilon;
}

/** The same with an automatic thickness. */
std::set<Edge>
CrossedEdges(const Volume & volume, const WallLimits & limits)
{
  const JointClassifier thresholds(volume, limits);
  Classifier            oracle(volume, limits.maximum);
  std::set<Edge>        edges;
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Edge   edge{ volume.IndexAt(i), axis };
      const Index3 other = Moved(edge.first, axis, 1);
      if (!volume.Contains(other) || !(volume.IsObject(edge.first) || volume.IsObject(other)) ||
          !HasFourCells(volume, edge))
      {
        continue;
      }
      const long a = oracle.GetNearest()[i];
      const long b = oracle.GetNearest()[volume.Offset(other)];
      if (a >= 0 && b >= 0 && oracle.GeodesicDistance(a, b) >= EpsilonOf(volume, thresholds, edge))
      {
        edges.insert(edge);
      }
    }
  }
  return edges;
}

std::vector<itk::MedialVoxelSurfaceCell>
CellsOf(const Volume & volume, const itk::MedialVoxelParameters & parameters, const Index3 & tileSize)
{
  const itk::MedialVoxelBox                whole = GridOf(volume).GetVoxelBox();
  std::vector<itk::MedialVoxelSurfaceCell> cells;
  for (const itk::MedialVoxelBox & tile : itk::MedialVoxelCutIntoTiles(whole, KernelIndex(tileSize)))
  {
    std::vector<itk::MedialVoxelSurfaceCell> part;
    EXPECT_TRUE(FindSurfaceCells(volume, parameters, tile, whole, part).IsEmpty());
    EXPECT_TRUE(std::is_sorted(part.begin(), part.end(), IsBefore));
    cells.insert(cells.end(), part.begin(), part.end());
  }
  std::sort(cells.begin(), cells.end(), IsBefore);
  return cells;
}

std::vector<itk::MedialVoxelSurfaceCell>
CellsOf(const Volume & volume, double tau, const Index3 & tileSize)
{
  return CellsOf(volume, FixedThickness(tau), tileSize);
}

void
ExpectEdges(const std::vector<itk::MedialVoxelSurfaceCell> & cells, const std::set<Edge> & expected)
{
  const std::map<Edge, int> found = EdgesOf(cells);
  std::set<Edge>            edges;
  for (const auto & edge : found)
  {
    edges.insert(edge.first);
    EXPECT_EQ(edge.second, 4) << "cells that share an edge disagree";
  }
  EXPECT_EQ(edges, expected);
}

/** Expects the vertices of the oracle in the cells; \return the number of cells that have more than one. */
std::size_t
ExpectVertices(const std::vector<itk::MedialVoxelSurfaceCell> & cells, const SurfaceOracle & oracle)
{
  std::map<Index3, std::set<std::set<Edge>>> vertices;
  for (const auto & cell : cells)
  {
    vertices[{ { cell.index[0], cell.index[1], cell.index[2] } }].insert(EdgesOf(cell));
  }
  EXPECT_EQ(vertices, oracle.GetVertices());
  return static_cast<std::size_t>(
    std::count_if(vertices.begin(), vertices.end(), [](const auto & cell) { return cell.second.size() > 1; }));
}

/** Whether two boundary points are the threshold of a face apart, by a classifier. */
template <typename TClassifier, typename TEpsilon>
SurfaceOracle::Questions
QuestionsTo(const Volume & volume, TClassifier & distances, Classifier & nearest, TEpsilon epsilonOf)
{
  const auto at = [&](const Index3 & v) { return nearest.GetNearest()[volume.Offset(v)]; };
  return { [&distances, at, epsilonOf](const Index3 & v, const Index3 & w, const Index3 & cell, const Index3 & behind) {
            return distances.GeodesicDistance(at(v), at(w)) >= std::max(epsilonOf(cell), epsilonOf(behind));
          },
           [&volume, &nearest, at](const Index3 & v, const Index3 & w) {
             return KeyDistance(volume, nearest.GetSites()[at(v)], nearest.GetSites()[at(w)]);
           } };
}

void
ExpectDefinition(const Volume & volume, double tau, PathSums sums = PathSums::Doubles)
{
  SCOPED_TRACE(tau);
  ExpectEdges(CellsOf(volume, tau, volume.size), CrossedEdges(volume, tau, sums));
}

itk::MedialVoxelParameters
ParametersOf(const WallLimits & limits)
{
  return itk::MedialVoxelParameters::ForWalls(
    limits.minimum, limits.maximum, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
}

bool
AreEqual(const itk::MedialVoxelSurfaceCell & a, const itk::MedialVoxelSurfaceCell & b)
{
  return a.index == b.index && a.quads == b.quads && a.offset == b.offset && a.normal == b.normal &&
         a.distance == b.distance && a.thickness == b.thickness;
}
} // namespace

TEST(MedialVoxelSurfaceCells, AreThoseOfTheDefinition)
{
  std::size_t edges = 0;
  for (unsigned int seed = 0; seed < 6; ++seed)
  {
    const Volume boxes = RandomBoxes({ { 22, 17, 15 } }, UnitSpacing, 14, 500 + seed);
    for (const double tau : { 1.3, 3.0, 6.1 })
    {
      ExpectDefinition(boxes, tau);
      edges += CrossedEdges(boxes, tau).size();
    }
  }
  EXPECT_GT(edges, 2000u);
  ExpectDefinition(RandomVolume({ { 16, 15, 14 } }, UnitSpacing, 0.7, 511), 3.0);
  ExpectDefinition(SphericalShell({ { 24, 24, 24 } }, { { 11.4, 11.7, 11.5 } }, 8.0, 3.0), 3.0);
  ExpectDefinition(LatticeOfHoles({ { 14, 14, 14 } }, UnitSpacing, 5), 2.0);
}

TEST(MedialVoxelSurfaceCells, AreThoseOfTheDefinitionForUnequalSpacing)
{
  for (const Vector3 & spacing : { Vector3{ { 0.5, 0.75, 1.5 } }, Vector3{ { 1.1, 0.3, 1.0 } } })
  {
    const Volume boxes = RandomBoxes({ { 22, 17, 15 } }, spacing, 14, 521);
    ExpectDefinition(boxes, 1.7);
    ExpectDefinition(boxes, 3.3);
  }
}

TEST(MedialVoxelSurfaceCells, PathsAsLongAsTheThresholdReachIt)
{
  const double tau = ThicknessForEpsilon(2.0);
  ASSERT_GT(tau, 0.0);
  ExpectDefinition(RandomBoxes({ { 12, 11, 10 } }, UnitSpacing, 10, 531), tau, PathSums::Exact);
}

TEST(MedialVoxelSurfaceCells, AreThoseOfTheDefinitionForAnAutomaticThickness)
{
  std::size_t edges = 0;
  for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 0.9, 1.1, 1.3 } } })
  {
    for (unsigned int seed = 0; seed < 3; ++seed)
    {
      const Volume boxes = RandomBoxes({ { 24, 19, 17 } }, spacing, 12, 551 + seed);
      for (const WallLimits & limits : { WallLimits{ 1.4, 9.0 }, WallLimits{ 3.0, 6.0 } })
      {
        const std::set<Edge> expected = CrossedEdges(boxes, limits);
        ExpectEdges(CellsOf(boxes, ParametersOf(limits), boxes.size), expected);
        edges += expected.size();
      }
    }
  }
  EXPECT_GT(edges, 1000u);
}

TEST(MedialVoxelSurfaceCells, VerticesArePartsOfTheSurface)
{
  std::size_t split = 0;
  for (unsigned int seed = 0; seed < 6; ++seed)
  {
    const Volume volume = seed % 2 == 0 ? RandomBoxes({ { 22, 17, 15 } }, UnitSpacing, 14, 561 + seed)
                                        : RandomVolume({ { 16, 15, 14 } }, { { 1.0, 1.2, 0.8 } }, 0.8, 561 + seed);
    for (const double tau : { 1.1, 1.7, 3.1 })
    {
      Classifier          classifier(volume, tau);
      const SurfaceOracle oracle(
        CrossedEdges(volume, tau),
        QuestionsTo(volume, classifier, classifier, [&](const Index3 &) { return classifier.GetEpsilon(); }));
      split += ExpectVertices(CellsOf(volume, tau, volume.size), oracle);
    }
    const WallLimits    limits{ 1.4, 9.0 };
    JointClassifier     thresholds(volume, limits);
    Classifier          nearest(volume, limits.maximum);
    const SurfaceOracle oracle(CrossedEdges(volume, limits),
                               QuestionsTo(volume, nearest, nearest, [&](const Index3 & cell) {
                                 return thresholds.EpsilonOf(volume.Offset(cell));
                               }));
    split += ExpectVertices(CellsOf(volume, ParametersOf(limits), volume.size), oracle);
  }
  EXPECT_GT(split, 200u);
}

TEST(MedialVoxelSurfaceCells, DoNotDependOnTheTiles)
{
  const Volume volume = RandomBoxes({ { 70, 25, 21 } }, { { 1.0, 1.2, 0.8 } }, 25, 541);
  for (const auto & parameters : { FixedThickness(3.0), ParametersOf({ 2.0, 12.0 }) })
  {
    const auto whole = CellsOf(volume, parameters, volume.size);
    ASSERT_GT(whole.size(), 500u);
    for (const Index3 & tileSize : { Index3{ { 70, 25, 1 } }, Index3{ { 7, 5, 3 } }, Index3{ { 64, 8, 8 } } })
    {
      const auto parts = CellsOf(volume, parameters, tileSize);
      ASSERT_EQ(parts.size(), whole.size());
      EXPECT_TRUE(std::equal(parts.begin(), parts.end(), whole.begin(), AreEqual));
    }
  }
}

TEST(MedialVoxelSurfaceCells, AskForTheSitesThatAnEdgeNeeds)
{
  // The paths around the end of a wall leave the tile.
  const Volume volume =
    MakeVolume({ { 40, 20, 20 } }, UnitSpacing, [](const Index3 & v) { return v[0] < 24 && v[2] > 5 && v[2] < 14; });
  const itk::MedialVoxelBox                whole = GridOf(volume).GetVoxelBox();
  const itk::MedialVoxelBox                tile = MakeBox({ { 16, 8, 8 } }, { { 20, 12, 12 } });
  std::vector<itk::MedialVoxelSurfaceCell> expected;
  ASSERT_TRUE(FindSurfaceCells(volume, FixedThickness(8.0), tile, whole, expected).IsEmpty());
  ASSERT_FALSE(expected.empty());

  itk::MedialVoxelBox                      known = tile;
  std::vector<itk::MedialVoxelSurfaceCell> cells;
  const itk::MedialVoxelBox                missing = FindSurfaceCells(volume, FixedThickness(8.0), tile, known, cells);
  ASSERT_FALSE(missing.IsEmpty());
  EXPECT_TRUE(whole.Contains(missing));
  EXPECT_FALSE(known.Contains(missing));
  known = known.Union(missing);
  EXPECT_TRUE(FindSurfaceCells(volume, FixedThickness(8.0), tile, known, cells).IsEmpty());
  ASSERT_EQ(cells.size(), expected.size());
  EXPECT_TRUE(std::equal(cells.begin(), cells.end(), expected.begin(), AreEqual));
}

TEST(MedialVoxelSurfaceCells, VolumesWithoutSurfaceHaveNone)
{
  EXPECT_TRUE(CellsOf(Volume({ { 9, 8, 7 } }, UnitSpacing), 3.0, { { 9, 8, 7 } }).empty());
  const auto full = MakeVolume({ { 9, 8, 7 } }, UnitSpacing, [](const Index3 &) { return true; });
  EXPECT_TRUE(CellsOf(full, 3.0, full.size).empty());
  EXPECT_TRUE(CellsOf(AxisPlate({ { 20, 20, 1 } }, UnitSpacing, 0, 6, 5), 3.0, { { 20, 20, 1 } }).empty());
  EXPECT_TRUE(CellsOf(AxisPlate({ { 20, 1, 20 } }, UnitSpacing, 0, 6, 5), 3.0, { { 20, 1, 20 } }).empty());
  const auto one = MakeVolume({ { 1, 1, 1 } }, UnitSpacing, [](const Index3 &) { return true; });
  EXPECT_TRUE(CellsOf(one, 3.0, one.size).empty());
}

TEST(MedialVoxelSurfaceCells, ThicknessIsThatOfTheWall)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int thickness = 1; thickness <= 8; ++thickness)
    {
      const Vector3 spacing{ { 0.5, 0.75, 1.5 } };
      const Volume  volume = AxisPlate({ { 16, 16, 16 } }, spacing, axis, 4, thickness);
      const auto    cells = CellsOf(volume, 1.5, volume.size);
      EXPECT_EQ(cells.size(), 15u * 15u);
      for (const auto & cell : cells)
      {
        EXPECT_NEAR(cell.thickness, thickness * spacing[axis], 1e-6);
      }
    }
  }
}
