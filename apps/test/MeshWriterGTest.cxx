// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshWriting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

using namespace medialvoxel;

namespace
{

const std::vector<std::string> Extensions{ ".vtp", ".vtu", ".vtk", ".ply", ".stl", ".obj", ".inp", ".bdf", ".k" };

float
GetFloat(const std::string & bytes, size_t offset)
{
  float value;
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

} // namespace

TEST(MeshWriter, FormatsGoByExtension)
{
  for (size_t format = 0; format < Extensions.size(); ++format)
  {
    EXPECT_EQ(GetMeshFormat("a.b/mesh" + Extensions[format]), static_cast<MeshFormat>(format));
  }
  EXPECT_EQ(GetMeshFormat("MESH.VTP"), MeshFormat::Vtp);
  for (const char * name : { "mesh", "mesh.xyz", "mesh.vtp.gz", "" })
  {
    EXPECT_EQ(GetStatusOf([&] { GetMeshFormat(name); }), ExitStatus::Usage) << name;
  }
}

TEST(MeshWriter, PiecesMakeNoDifference)
{
  for (const char * shape : { "mixed", "cylinder", "junction" })
  {
    const TestMesh surface = MakeTestMesh(shape);
    for (const std::string & extension : Extensions)
    {
      MeshWriteOptions options;
      options.thicknessClassWidth = 0.1;
      const std::string expected = WriteFile(surface, extension, options);
      for (const size_t pieceSize : { 1, 7 })
      {
        EXPECT_EQ(WriteFile(surface, extension, options, pieceSize), expected) << shape << extension;
      }
      // Each section by itself, and some together.
      for (const std::uint64_t keptNumbers : { 1, 10 })
      {
        options.keptNumbers = keptNumbers;
        EXPECT_EQ(WriteFile(surface, extension, options), expected) << shape << extension;
      }
    }
  }
}

TEST(MeshWriter, Obj)
{
  EXPECT_EQ(WriteFile(MakeTwoFaces(), ".obj"),
            "# Medial surface by MedialVoxel, coordinates and thickness in units of the spacing\n"
            "v 0 0 0\nv 4 0 0\nv 5 3 0\nv 1 1.5 0\nv -2 0 1e-05\nf 1 2 3 4\nf 1 4 5\n");
}

TEST(MeshWriter, WallsOfFaces)
{
  TestMesh surface = MakeTwoFaces();
  surface.faces[1].wall = 258;
  MeshWriteOptions options;
  options.hasWalls = true;
  EXPECT_NE(WriteFile(surface, ".vtk", options)
              .find("SCALARS Wall unsigned_int 1\nLOOKUP_TABLE default\n" + std::string("\0\0\0\0\0\0\1\2\n", 9)),
            std::string::npos);
  for (const char * extension : { ".vtp", ".vtu" })
  {
    const std::string text = WriteFile(surface, extension, options);
    EXPECT_NE(text.find("<DataArray type=\"UInt32\" Name=\"Wall\""), std::string::npos);
    const std::string numbers = std::string("\x8\0\0\0\0\0\0\0", 8) + std::string("\0\0\0\0\2\1\0\0", 8);
    EXPECT_NE(text.find(numbers), std::string::npos);
  }
  const std::string ply = WriteFile(surface, ".ply", options);
  EXPECT_NE(ply.find("vertex_indices\nproperty uint wall\nend_header\n"), std::string::npos);
  const std::string last("\x3\0\0\0\0\x3\0\0\0\x4\0\0\0\2\1\0\0", 17);
  EXPECT_EQ(ply.substr(ply.size() - last.size()), last);
  EXPECT_NE(WriteFile(surface, ".obj", options).find("f 1 2 3 4\ng WALL_258\nf 1 4 5\n"), std::string::npos);
  for (const std::string & extension : Extensions)
  {
    const MeshFormat format = GetMeshFormat("m" + extension);
    const auto       without = WriteFile(MakeTwoFaces(), extension);
    EXPECT_EQ(WriteFile(surface, extension, options) != without, HoldsWalls(format)) << extension;
  }
}

TEST(MeshWriter, StlSplitsQuadsAlongTheShorterDiagonal)
{
  const std::string bytes = WriteFile(MakeTwoFaces(), ".stl");
  ASSERT_EQ(bytes.size(), 84 + 3 * 50);
  EXPECT_EQ(bytes[80], 3);
  // Corners 0, 1, 3 of the quad, seen from above: the normal is z, the third corner is (1, 1.5, 0).
  EXPECT_EQ(GetFloat(bytes, 84 + 8), 1.0f);
  EXPECT_EQ(GetFloat(bytes, 84 + 12 + 24), 1.0f);
  EXPECT_EQ(GetFloat(bytes, 84 + 12 + 28), 1.5f);
  // In a square both are equally long: corners 0, 1, 2, so the third corner of the first triangle is (1, 1, 0).
  const std::string square = WriteFile(MakeSquares({ 1 }), ".stl");
  EXPECT_EQ(GetFloat(square, 84 + 12 + 24), 1.0f);
  EXPECT_EQ(GetFloat(square, 84 + 12 + 28), 1.0f);
}

TEST(MeshWriter, StlOfATriangleWithoutAreaHasNoNormal)
{
  TestMesh surface = MakeTwoFaces();
  surface.faces = { MakeFace({ 0, 1, 0 }) };
  const std::string bytes = WriteFile(surface, ".stl");
  for (size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(GetFloat(bytes, 84 + 4 * axis), 0.0f);
  }
}

TEST(MeshWriter, LegacyVtkHasTheHighByteFirst)
{
  const std::string bytes = WriteFile(MakeTwoFaces(), ".vtk");
  // A quad is the number 4 and its corners.
  const std::string polygons("POLYGONS 2 9\n\0\0\0\4\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0\3", 33);
  EXPECT_NE(bytes.find(polygons), std::string::npos);
}

TEST(MeshWriter, CoordinatesAreFloat32InAllFormats)
{
  TestMesh surface = MakeTwoFaces();
  surface.vertices[0].position = { 1.0 / 3, -1e-9, 123456.789 };
  EXPECT_EQ(GetLinesAfter(WriteFile(surface, ".inp"), "*NODE").front(), "1, 0.33333334, -1e-09, 123456.79");
  const std::string nastran = WriteFile(surface, ".bdf");
  EXPECT_NE(
    nastran.find("GRID*   1                               0.33333334      -1.e-09         \n*       123456.79\n"),
    std::string::npos);
}

TEST(MeshWriter, CoordinatesAreFloat64WhereTheSurfaceNeedsIt)
{
  TestMesh surface = MakeTwoFaces();
  surface.vertices[0].position = { 20000000.1, -1.0 / 3, -20000000.123456789 };
  const auto write = [&](const std::string & extension) {
    return WriteFile(surface, extension, {}, 1000, MeshPrecision::Double);
  };
  EXPECT_EQ(GetLinesAfter(write(".inp"), "*NODE").front(), "1, 20000000.1, -0.3333333333333333, -20000000.123456787");
  // As many digits as its fields hold.
  EXPECT_NE(write(".bdf").find("20000000.1      -0.3333333333333\n*       -20000000.123457\n"), std::string::npos);
  EXPECT_NE(write(".vtp").find("<DataArray type=\"Float64\" Name=\"Points\""), std::string::npos);
  EXPECT_NE(write(".vtu").find("<DataArray type=\"Float64\" Name=\"Points\""), std::string::npos);
  EXPECT_NE(write(".vtk").find("POINTS 5 double\n"), std::string::npos);
  EXPECT_NE(write(".ply").find("property double x\n"), std::string::npos);
}

TEST(MeshWriter, RefusesMoreThanAFormatHolds)
{
  struct Case
  {
    MeshFormat    format;
    std::uint64_t vertices;
    std::uint64_t triangles;
    std::uint64_t quads;
  };
  const std::uint64_t     int32 = std::numeric_limits<std::int32_t>::max();
  const std::uint64_t     uint32 = std::numeric_limits<std::uint32_t>::max();
  const std::vector<Case> largest{
    { MeshFormat::Vtk, int32, 1, (int32 - 4) / 5 }, { MeshFormat::Ply, int32, 7, int32 - 7 },
    { MeshFormat::Stl, uint32 * 2, 1, uint32 / 2 }, { MeshFormat::Abaqus, 999999999, 9, 999999990 },
    { MeshFormat::Nastran, 99999999, 9, 99999990 }, { MeshFormat::LsDyna, 99999999, 9, 99999990 }
  };
  for (const auto & [format, vertices, triangles, quads] : largest)
  {
    EXPECT_NO_THROW(CheckMeshFits(format, vertices, triangles, quads));
    EXPECT_EQ(GetStatusOf([&, f = format, v = vertices, t = triangles, q = quads] { CheckMeshFits(f, v, t, q + 1); }),
              ExitStatus::Refused);
    if (format != MeshFormat::Stl)
    {
      EXPECT_EQ(GetStatusOf([&, f = format, v = vertices] { CheckMeshFits(f, v + 1, 0, 0); }), ExitStatus::Refused);
    }
  }
  for (const MeshFormat format : { MeshFormat::Vtp, MeshFormat::Vtu, MeshFormat::Obj })
  {
    EXPECT_NO_THROW(CheckMeshFits(format, uint32 * 100, uint32, uint32 * 100));
  }
  try
  {
    CheckMeshFits(MeshFormat::Stl, 0, 2, uint32 / 2);
    FAIL() << "too many triangles";
  }
  catch (const JobError & error)
  {
    EXPECT_NE(std::string(error.what()).find("4294967295"), std::string::npos) << error.what();
  }
}

TEST(MeshWriter, NoticesAVertexThatIsMissing)
{
  TestMesh surface = MakeTwoFaces();
  surface.vertices.pop_back();
  for (const std::string & extension : Extensions)
  {
    EXPECT_EQ(GetStatusOf([&] { WriteFile(surface, extension); }), ExitStatus::Failure) << extension;
  }
  // The fourth number of a triangle counts for nothing.
  surface.faces[1] = MakeFace({ 0, 1, 2 });
  surface.faces[1].vertices[3] = 1000;
  EXPECT_NO_THROW(WriteFile(surface, ".stl"));
}

TEST(MeshWriter, AnEmptySurfaceIsAFile)
{
  for (const std::string & extension : Extensions)
  {
    EXPECT_FALSE(WriteFile(MakeTestMesh("empty"), extension).empty()) << extension;
  }
}

TEST(MeshWriter, ProgressRisesToOneAndMayStop)
{
  const TestMesh surface = MakeSquares(std::vector<double>(2000, 1.0));
  for (const std::string & extension : Extensions)
  {
    double           last = 0;
    MeshWriteOptions options;
    options.progress = [&last](double fraction) {
      EXPECT_GE(fraction, last);
      last = fraction;
    };
    WriteFile(surface, extension, options);
    EXPECT_DOUBLE_EQ(last, 1.0) << extension;
    options.progress = [](double) { throw StoppedBySignal(2); };
    EXPECT_THROW(WriteFile(surface, extension, options), StoppedBySignal) << extension;
  }
}

TEST(MeshSpool, RefusesAFolderThatIsMissing)
{
  const TemporaryFolder folder;
  EXPECT_EQ(GetStatusOf([&] { MeshSpool spool(folder / "missing"); }), ExitStatus::Refused);
}

TEST(MeshSpool, RoundsToItsPrecision)
{
  const std::vector<MeshVertex> vertices(9, { { 1.0 / 3, -2.0 / 3, 20000000.1 }, 1.0 });
  for (const MeshPrecision precision : { MeshPrecision::Single, MeshPrecision::Double })
  {
    const TemporaryFolder          folder;
    MeshSpool                      spool(folder / "", precision);
    std::vector<MeshSpool::Vertex> read;
    spool.AddVertices(vertices);
    spool.ReadVertices(0, vertices.size(), read);
    for (size_t i = 0; i < vertices.size(); ++i)
    {
      for (size_t axis = 0; axis < 3; ++axis)
      {
        const volatile float rounded = static_cast<float>(vertices[i].position[axis]);
        EXPECT_EQ(read[i].position[axis],
                  precision == MeshPrecision::Single ? static_cast<double>(rounded) : vertices[i].position[axis]);
      }
    }
  }
}

TEST(MeshSpool, LeavesNoFile)
{
  const TemporaryFolder folder;
  MeshSpool             spool(folder / "");
  AddInPieces(MakeTestMesh("plate"), 3, spool);
  EXPECT_EQ(folder.GetNumberOfFiles(), 0);
  EXPECT_EQ(spool.GetNumberOfVertices(), 24U);
  EXPECT_EQ(spool.GetNumberOfFaces(), 15U);
}
