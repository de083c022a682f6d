// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetCoarsening.h"

#include "MeshPartition.h"
#include "SheetQuality.h"
#include "MeshReader.h"
#include "TestMeshes.h"

#include "itkMedialVoxelSheetDistances.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace medialvoxel
{
namespace
{

/** More faces than two parts have. */
std::unique_ptr<MeshSpool>
MakeLargeStrip()
{
  auto  spool = std::make_unique<MeshSpool>(std::filesystem::temp_directory_path());
  Strip strip;
  strip.columns = 500;
  strip.rows = 320;
  strip.length = 500;
  strip.width = 320;
  strip.thicknessAtBegin = 4;
  strip.thicknessAtEnd = 8;
  AddStrip(strip, *spool);
  return spool;
}

SheetRemeshing
MakeRemeshing(const unsigned int threads)
{
  SheetRemeshing remeshing;
  remeshing.size = { 2.0, true, true, 0.5 };
  remeshing.scratchFolder = std::filesystem::temp_directory_path();
  remeshing.memoryLimit = std::uint64_t{ 1 } << 30;
  remeshing.threads = threads;
  remeshing.progress = [](double) {};
  return remeshing;
}

/** All records of a surface. */
struct Content
{
  std::vector<MeshSpool::Vertex> vertices;
  std::vector<MeshFace>          faces;

  explicit Content(const MeshSpool & surface)
  {
    surface.ReadVertices(0, surface.GetNumberOfVertices(), vertices);
    surface.ReadFaces(0, surface.GetNumberOfFaces(), faces);
  }

  double
  GetArea() const
  {
    double area = 0.0;
    for (const MeshFace & face : faces)
    {
      for (unsigned int k = 2; k < face.numberOfVertices; ++k)
      {
        const auto & a = vertices[face.vertices[0]].position;
        const auto   u = itk::MedialVoxelSubtract(vertices[face.vertices[k - 1]].position, a);
        const auto   v = itk::MedialVoxelSubtract(vertices[face.vertices[k]].position, a);
        area += itk::MedialVoxelNorm(itk::MedialVoxelCross(u, v)) / 2.0;
      }
    }
    return area;
  }

  std::map<std::pair<std::uint64_t, std::uint64_t>, int>
  CountSides() const
  {
    std::map<std::pair<std::uint64_t, std::uint64_t>, int> sides;
    for (const MeshFace & face : faces)
    {
      for (unsigned int k = 0; k < face.numberOfVertices; ++k)
      {
        ++sides[std::minmax(face.vertices[k], face.vertices[(k + 1) % face.numberOfVertices])];
      }
    }
    return sides;
  }
};

TEST(MeshPartition, PartsAreSmall)
{
  const auto              surface = MakeLargeStrip();
  MeshReader              reader(*surface, {});
  const MeshPartition     partition(reader, 10000);
  std::map<unsigned, int> faces;
  reader.ForEachFace(
    [&](std::uint64_t, const MeshFace & face) { ++faces[partition.GetPart(reader.GetVertex(face.vertices[0]))]; });
  EXPECT_EQ(faces.size(), partition.GetNumberOfParts());
  EXPECT_GE(faces.size(), 16u);
  EXPECT_LE(faces.size(), 32u);
  for (const auto & [part, number] : faces)
  {
    EXPECT_LE(number, 10000) << part;
  }
}

TEST(MeshPartition, OnePlaceIsOnePart)
{
  MeshSpool  surface(std::filesystem::temp_directory_path());
  MeshVertex vertex{};
  surface.AddVertices({ vertex, vertex, vertex });
  surface.AddFaces({ MakeFace({ 0, 1, 2 }), MakeFace({ 2, 1, 0 }) });
  MeshReader          reader(surface, {});
  const MeshPartition partition(reader, 1);
  EXPECT_EQ(partition.GetNumberOfParts(), 1u);
}

TEST(SheetCoarsening, PartsMakeOneSurfaceWithFewerFaces)
{
  const SheetCoarsening                    coarsening(MakeLargeStrip(), MakeRemeshing(2));
  std::vector<itk::MedialVoxelWallLeftOut> wallsLeftOut;
  const auto                               coarse = coarsening.Coarsen(wallsLeftOut);
  const Content                            content(*coarse);
  EXPECT_TRUE(wallsLeftOut.empty());
  EXPECT_LT(content.faces.size(), 80000u);
  EXPECT_NEAR(content.GetArea(), 160000.0, 4.0); // corners are cut by parts of triangles
  std::size_t rims = 0;
  for (const auto & [side, number] : content.CountSides())
  {
    ASSERT_LE(number, 2);
    rims += number == 1 ? 1 : 0;
    for (const std::uint64_t end : { side.first, side.second })
    {
      const auto & point = content.vertices[end].position;
      EXPECT_TRUE(number == 2 || point[0] == 0 || point[0] == 500 || point[1] == 0 || point[1] == 320);
    }
  }
  EXPECT_GT(rims, 100u);
}

TEST(SheetRemeshing, ThreadsDoNotChangeTheMesh)
{
  std::vector<Content> contents;
  for (const unsigned int threads : { 1u, 2u, 5u })
  {
    itk::MedialVoxelRemeshingSummary summary;
    const auto                       remeshed = RemeshSheet(MakeLargeStrip(), MakeRemeshing(threads), summary);
    contents.emplace_back(*remeshed);
    EXPECT_EQ(summary.fineArea, 160000.0);
    EXPECT_EQ(summary.walls, 1u);
    EXPECT_LT(summary.toFine.largest, 1e-9);
    EXPECT_LT(summary.fromFine.largest, 1.0); // corners are cut
    for (const MeshLimit & limit : ListMeshLimits(MeasureQuality(*remeshed)))
    {
      EXPECT_TRUE(limit.Holds()) << limit.name << ": " << limit.value;
    }
    const auto & first = contents.front();
    const auto & last = contents.back();
    ASSERT_EQ(last.vertices.size(), first.vertices.size());
    ASSERT_EQ(last.faces.size(), first.faces.size());
    for (std::size_t k = 0; k < last.vertices.size(); ++k)
    {
      ASSERT_EQ(last.vertices[k].position, first.vertices[k].position);
      ASSERT_EQ(last.vertices[k].thickness, first.vertices[k].thickness);
      ASSERT_NEAR(last.vertices[k].thickness, 4.0 + last.vertices[k].position[0] / 125.0, 0.05);
    }
    for (std::size_t k = 0; k < last.faces.size(); ++k)
    {
      ASSERT_EQ(last.faces[k].vertices, first.faces[k].vertices);
    }
  }
}

TEST(SheetRemeshing, AWallThatIsSmallerThanAnElementIsListedOnce)
{
  auto                       surface = MakeLargeStrip();
  const std::uint64_t        first = surface->GetNumberOfVertices();
  std::vector<MeshVertex>    corners;
  const std::array<float, 2> ends{ { 0.0F, 0.25F } };
  for (const float y : ends)
  {
    for (const float x : ends)
    {
      corners.push_back({ { { 100.0 + x, 90.0 + y, 50.0 } }, 2.0, 0 });
    }
  }
  surface->AddVertices(corners);
  surface->AddFaces({ MakeFace({ static_cast<std::uint32_t>(first),
                                 static_cast<std::uint32_t>(first + 1),
                                 static_cast<std::uint32_t>(first + 3),
                                 static_cast<std::uint32_t>(first + 2) }) });
  itk::MedialVoxelRemeshingSummary summary;
  RemeshSheet(std::move(surface), MakeRemeshing(2), summary);
  EXPECT_EQ(summary.walls, 2u);
  ASSERT_EQ(summary.wallsLeftOut.size(), 1u);
  // Coarse triangles may have cut its corners.
  EXPECT_GE(summary.wallsLeftOut[0].area, 0.03);
  EXPECT_LE(summary.wallsLeftOut[0].area, 0.0625);
  EXPECT_NEAR(summary.wallsLeftOut[0].place[2], 50.0, 1e-6);
}

TEST(SheetRemeshing, StopsWhenProgressThrows)
{
  SheetRemeshing remeshing = MakeRemeshing(2);
  unsigned int   calls = 0;
  remeshing.progress = [&](double) {
    if (++calls > 800)
    {
      throw std::runtime_error("stop");
    }
  };
  itk::MedialVoxelRemeshingSummary summary;
  EXPECT_THROW(RemeshSheet(MakeLargeStrip(), remeshing, summary), std::runtime_error);
}

} // namespace
} // namespace medialvoxel
