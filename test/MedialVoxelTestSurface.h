// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestSurface_h
#define MedialVoxelTestSurface_h

// Medial surfaces of test volumes, by the kernels alone, and measures of their quality.

#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestParameters.h"

#include "itkMedialVoxelSurfaceTrimmer.h"
#include "itkMedialVoxelSlabPlan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace MedialVoxelTest
{
/** A surface in memory. */
struct Surface : public itk::MedialVoxelSurfaceConsumer
{
  std::vector<itk::MedialVoxelSurfaceVertex> vertices;
  std::vector<itk::MedialVoxelSurfaceQuad>   quads;

  void
  AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & more) override
  {
    vertices.insert(vertices.end(), more.begin(), more.end());
  }

  void
  AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & more) override
  {
    quads.insert(quads.end(), more.begin(), more.end());
  }
};

/** The cells of the surface in a tile, from the sites in `known`; \return the box of sites that are missing. */
inline itk::MedialVoxelBox
FindSurfaceCells(const Volume &                             volume,
                 const itk::MedialVoxelParameters &         parameters,
                 const itk::MedialVoxelBox &                tile,
                 const itk::MedialVoxelBox &                known,
                 std::vector<itk::MedialVoxelSurfaceCell> & cells)
{
  const itk::MedialVoxelGrid                  grid = GridOf(volume);
  const itk::MedialVoxelBits                  object = ObjectBits(volume, grid.GetVoxelBox());
  const itk::MedialVoxelBits                  sites = SiteBits(BoundarySites(volume), grid.GetVoxelBox());
  const itk::MedialVoxelBits                  knownSites = SiteBits(BoundarySites(volume), known);
  const itk::MedialVoxelClassifier            classifier(grid, parameters);
  const itk::MedialVoxelFeatureTransform      transform(grid);
  itk::MedialVoxelFeatureTransform::Workspace transformWorkspace;
  itk::MedialVoxelFeatures                    features;
  itk::MedialVoxelClassifier::Workspace       workspace;
  const itk::MedialVoxelWindow                window = classifier.FindAsked({ &object, &sites }, tile, true, workspace);
  EXPECT_TRUE(transform.Compute(window, classifier.GetVoxelBox(tile), transformWorkspace, features).IsEmpty());
  std::vector<std::uint8_t>        labels;
  itk::MedialVoxelCounts           counts;
  const itk::MedialVoxelNoProgress progress;
  workspace.keepsRows = true;
  EXPECT_TRUE(classifier.Classify(window, tile, features, progress, workspace, labels, counts).IsEmpty());

  const itk::MedialVoxelSurfaceCells      kernel(grid, parameters, volume.spacing);
  itk::MedialVoxelSurfaceCells::Workspace surfaceWorkspace;
  const itk::MedialVoxelWindow            knownWindow{ &object, &knownSites, window.asked };
  const itk::MedialVoxelPairDecision      decision(grid, parameters);
  decision.Begin(knownSites, tile, workspace.geodesic);
  const std::vector<itk::MedialVoxelWall>  noWalls;
  const itk::MedialVoxelGray               noGray;
  itk::MedialVoxelGrayThickness::Workspace noFits;
  return kernel.Find(
    { tile, knownWindow, features, classifier, workspace.rows, noWalls, workspace, progress, noGray, noFits },
    surfaceWorkspace,
    cells);
}

/** Index i is at the point i * spacing. */
inline itk::MedialVoxelSurfacePlacement
PlacementOf(const Volume & volume)
{
  itk::MedialVoxelSurfacePlacement placement;
  for (int axis = 0; axis < 3; ++axis)
  {
    placement.steps[axis][axis] = volume.spacing[axis];
  }
  return placement;
}

inline bool
IsBefore(const itk::MedialVoxelSurfaceCell & a, const itk::MedialVoxelSurfaceCell & b)
{
  return std::lexicographical_compare(a.index.rbegin(), a.index.rend(), b.index.rbegin(), b.index.rend()) ||
         (a.index == b.index && (a.quads & -a.quads) < (b.quads & -b.quads));
}

/** The surface that sorted cells make, of batches whose tasks run in the wrong order. */
inline void
FillSurface(const itk::MedialVoxelSurfacePlacement &         placement,
            const Vector3 &                                  spacing,
            const std::vector<itk::MedialVoxelSurfaceCell> & cells,
            Surface &                                        surface,
            const std::size_t                                verticesOfBatch = 0)
{
  itk::MedialVoxelSurfaceBuilder builder(placement, spacing, surface);
  if (verticesOfBatch > 0)
  {
    const auto backwards = [](std::size_t count, const auto & task) {
      while (count > 0)
      {
        task(--count);
      }
    };
    builder.RunTasksWith(backwards, verticesOfBatch);
  }
  itk::MedialVoxelSurfaceTrimmer trimmer(builder);
  for (auto begin = cells.begin(); begin != cells.end();)
  {
    const auto end =
      std::find_if(begin, cells.end(), [&](const auto & cell) { return cell.index[2] != begin->index[2]; });
    trimmer.AddSlice(begin->index[2], { begin, end });
    begin = end;
  }
  trimmer.Finish();
}

/** The surface of a volume. */
inline Surface
MakeSurface(const Volume & volume, const itk::MedialVoxelParameters & parameters)
{
  const itk::MedialVoxelBox                whole = GridOf(volume).GetVoxelBox();
  std::vector<itk::MedialVoxelSurfaceCell> cells;
  EXPECT_TRUE(FindSurfaceCells(volume, parameters, whole, whole, cells).IsEmpty());
  Surface surface;
  FillSurface(PlacementOf(volume), volume.spacing, cells, surface);
  return surface;
}

inline Surface
MakeSurface(const Volume & volume, double tau)
{
  return MakeSurface(volume, FixedThickness(tau));
}

/** Whether a point counts. */
using PointTest = std::function<bool(const Vector3 &)>;

/** (b - a) x (c - a). */
inline Vector3
Cross(const Vector3 & a, const Vector3 & b, const Vector3 & c)
{
  const Vector3 u{ { b[0] - a[0], b[1] - a[1], b[2] - a[2] } };
  const Vector3 v{ { c[0] - a[0], c[1] - a[1], c[2] - a[2] } };
  return { { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] } };
}

/** How good a surface is, from what its quadrilaterals say alone. */
struct SurfaceQuality
{
  std::size_t         boundarySides{ 0 };    ///< sides of one quadrilateral where `mayEnd` does not hold
  std::size_t         nonManifoldSides{ 0 }; ///< sides of more than two where `mayMeet` does not hold
  std::size_t         pieces{ 0 };
  std::vector<double> angles; ///< smallest angle of each triangle in degrees, sorted

  double
  AngleOfOneInHundred() const
  {
    return angles.at(angles.size() / 100);
  }
};

/** The two triangles of a quadrilateral: from an end of the shorter diagonal to the other. */
inline std::array<std::array<std::uint64_t, 3>, 2>
TrianglesOf(const itk::MedialVoxelSurfaceQuad & quad)
{
  const auto & v = quad.vertices;
  if (quad.isSplitAlong13)
  {
    return { { { { v[1], v[2], v[3] } }, { { v[3], v[0], v[1] } } } };
  }
  return { { { { v[0], v[1], v[2] } }, { { v[2], v[3], v[0] } } } };
}

/** Smallest angle of a triangle in degrees. */
inline double
SmallestAngle(const Vector3 & a, const Vector3 & b, const Vector3 & c)
{
  const auto angleAt = [](const Vector3 & p, const Vector3 & q, const Vector3 & r) {
    const Vector3 u{ { q[0] - p[0], q[1] - p[1], q[2] - p[2] } };
    const Vector3 v{ { r[0] - p[0], r[1] - p[1], r[2] - p[2] } };
    const double  cosine = Dot(u, v) / std::sqrt(Dot(u, u) * Dot(v, v));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / 3.14159265358979323846;
  };
  return std::min({ angleAt(a, b, c), angleAt(b, c, a), angleAt(c, a, b) });
}

/** Sides by their two vertices, with the number of quadrilaterals that have them. */
inline std::map<std::pair<std::uint64_t, std::uint64_t>, int>
CountSides(const Surface & surface)
{
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> sides;
  for (const auto & quad : surface.quads)
  {
    for (int side = 0; side < 4; ++side)
    {
      ++sides[std::minmax(quad.vertices[side], quad.vertices[(side + 1) % 4])];
    }
  }
  return sides;
}

inline std::size_t
CountPieces(const Surface & surface)
{
  std::vector<std::uint64_t> parent(surface.vertices.size());
  for (std::size_t i = 0; i < parent.size(); ++i)
  {
    parent[i] = i;
  }
  const auto find = [&](std::uint64_t vertex) {
    while (parent[vertex] != vertex)
    {
      vertex = parent[vertex] = parent[parent[vertex]];
    }
    return vertex;
  };
  std::size_t pieces = parent.size();
  for (const auto & side : CountSides(surface))
  {
    const auto a = find(side.first.first);
    const auto b = find(side.first.second);
    pieces -= a != b ? 1 : 0;
    parent[a] = b;
  }
  return pieces;
}

inline SurfaceQuality
MeasureQuality(const Surface & surface, const PointTest & mayEnd, const PointTest & mayMeet)
{
  SurfaceQuality quality;
  for (const auto & side : CountSides(surface))
  {
    const Vector3 & a = surface.vertices[side.first.first].point;
    const Vector3 & b = surface.vertices[side.first.second].point;
    quality.boundarySides += side.second == 1 && !(mayEnd(a) && mayEnd(b)) ? 1 : 0;
    quality.nonManifoldSides += side.second > 2 && !(mayMeet(a) && mayMeet(b)) ? 1 : 0;
  }
  for (const auto & quad : surface.quads)
  {
    for (const auto & triangle : TrianglesOf(quad))
    {
      quality.angles.push_back(SmallestAngle(
        surface.vertices[triangle[0]].point, surface.vertices[triangle[1]].point, surface.vertices[triangle[2]].point));
    }
  }
  std::sort(quality.angles.begin(), quality.angles.end());
  quality.pieces = CountPieces(surface);
  return quality;
}

/** Mean of a distance over the vertices for which a test holds. */
inline double
MeanDistance(const Surface & surface, const std::function<double(const Vector3 &)> & distance, const PointTest & counts)
{
  double      sum = 0.0;
  std::size_t number = 0;
  for (const auto & vertex : surface.vertices)
  {
    if (counts(vertex.point))
    {
      sum += distance(vertex.point);
      ++number;
    }
  }
  return sum / static_cast<double>(number);
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestSurface_h
