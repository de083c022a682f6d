// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceFormat.h"

#include "Errors.h"
#include "SurfaceShapes.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

using namespace medialvoxel;

namespace
{

const std::vector<std::string> Extensions{ ".vtp", ".vtu", ".vtk", ".ply", ".stl", ".obj", ".inp", ".bdf" };

/** The bytes of the file that the surface becomes. */
std::string
WriteFile(const Surface &             surface,
          const std::string &         extension,
          const SurfaceWriteOptions & options = SurfaceWriteOptions(),
          size_t                      pieceSize = 1000,
          SurfacePrecision            precision = SurfacePrecision::Single)
{
  const TemporaryFolder folder;
  const std::string     name = "mesh" + extension;
  SurfaceSpool          spool(folder / "", precision);
  AddInPieces(surface, pieceSize, spool);
  OutputFile file(folder / name, false);
  file.Create(0, false);
  WriteSurface(GetSurfaceFormat(name), spool, options, file);
  file.Publish();
  return folder.Read(name);
}

/** One triangle and one quad; the quad's second diagonal is the shorter one. */
Surface
MakeTwoFaces()
{
  Surface surface;
  surface.vertices = {
    { { 0, 0, 0 }, 1.0 }, { { 4, 0, 0 }, 1.0 }, { { 5, 3, 0 }, 2.0 }, { { 1, 1.5, 0 }, 2.0 }, { { -2, 0, 1e-5 }, 1.5 }
  };
  surface.faces = { MakeFace({ 0, 1, 2, 3 }), MakeFace({ 0, 3, 4 }) };
  surface.faces[0].area = 3;
  surface.faces[1].area = 1;
  surface.faces[0].rimEdges = 7;
  surface.faces[1].junctionEdges = 2;
  return surface;
}

/** A row of squares, each with a thickness of its own. */
Surface
MakeSquares(const std::vector<double> & thicknesses)
{
  Surface surface;
  for (const double thickness : thicknesses)
  {
    const std::uint64_t first = surface.vertices.size();
    const auto          x = static_cast<double>(first);
    for (const auto & [dx, dy] : { std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1) })
    {
      surface.vertices.push_back({ { x + dx, static_cast<double>(dy), 0 }, thickness });
    }
    surface.faces.push_back(MakeFace({ first, first + 1, first + 2, first + 3 }));
  }
  CompleteFaces(surface);
  return surface;
}

/** Lines of the text that follow those that begin with \a begin. */
std::vector<std::string>
GetLinesAfter(const std::string & text, const std::string & begin)
{
  std::vector<std::string> lines;
  std::istringstream       stream(text);
  for (std::string line, previous; std::getline(stream, line); previous = line)
  {
    if (previous.rfind(begin, 0) == 0)
    {
      lines.push_back(line);
    }
  }
  return lines;
}

ExitStatus
GetStatusOf(const std::function<void()> & function)
{
  try
  {
    function();
  }
  catch (const JobError & error)
  {
    return error.GetStatus();
  }
  return ExitStatus::Done;
}

float
GetFloat(const std::string & bytes, size_t offset)
{
  float value;
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

} // namespace

TEST(SurfaceWriter, FormatsGoByExtension)
{
  for (size_t format = 0; format < Extensions.size(); ++format)
  {
    EXPECT_EQ(GetSurfaceFormat("a.b/mesh" + Extensions[format]), static_cast<SurfaceFormat>(format));
  }
  EXPECT_EQ(GetSurfaceFormat("MESH.VTP"), SurfaceFormat::Vtp);
  for (const char * name : { "mesh", "mesh.xyz", "mesh.vtp.gz", "" })
  {
    EXPECT_EQ(GetStatusOf([&] { GetSurfaceFormat(name); }), ExitStatus::Usage) << name;
  }
}

TEST(SurfaceWriter, PiecesMakeNoDifference)
{
  for (const char * shape : { "mixed", "cylinder", "junction" })
  {
    const Surface surface = MakeSurface(shape);
    for (const std::string & extension : Extensions)
    {
      SurfaceWriteOptions options;
      options.thicknessClassWidth = 0.1;
      const std::string expected = WriteFile(surface, extension, options);
      for (const size_t pieceSize : { 1, 7 })
      {
        EXPECT_EQ(WriteFile(surface, extension, options, pieceSize), expected) << shape << extension;
      }
      // Each section by itself, and some together.
      for (const std::uint64_t keptElements : { 1, 10 })
      {
        options.keptElements = keptElements;
        EXPECT_EQ(WriteFile(surface, extension, options), expected) << shape << extension;
      }
    }
  }
}

TEST(SurfaceWriter, Obj)
{
  EXPECT_EQ(WriteFile(MakeTwoFaces(), ".obj"),
            "# Medial surface by MedialVoxel, lengths in the units of the image\n"
            "v 0 0 0\nv 4 0 0\nv 5 3 0\nv 1 1.5 0\nv -2 0 1e-05\nf 1 2 3 4\nf 1 4 5\n");
}

TEST(SurfaceWriter, AbaqusInWhole)
{
  // The quad has the thickness 1.5 and the triangle too, so they share a section.
  EXPECT_EQ(WriteFile(MakeTwoFaces(), ".inp"),
            "*HEADING\nMedial surface by MedialVoxel, lengths in the units of the image\n*NODE, NSET=ALL_NODES\n"
            "1, 0, 0, 0\n2, 4, 0, 0\n3, 5, 3, 0\n4, 1, 1.5, 0\n5, -2, 0, 1e-05\n"
            "*ELEMENT, TYPE=S3, ELSET=TRIANGLES\n2, 1, 4, 5\n*ELEMENT, TYPE=S4, ELSET=QUADS\n1, 1, 2, 3, 4\n"
            "*ELSET, ELSET=THICKNESS_1\n1, 2\n*ELSET, ELSET=RIM\n1\n*ELSET, ELSET=JUNCTION\n2\n"
            "**\n** A placeholder (aluminum in N, mm, t): put in your material.\n"
            "*MATERIAL, NAME=REPLACE_THIS_MATERIAL\n*ELASTIC\n70000., 0.33\n*DENSITY\n2.7e-9\n"
            "*SHELL SECTION, ELSET=THICKNESS_1, MATERIAL=REPLACE_THIS_MATERIAL\n1.5\n");
}

TEST(SurfaceWriter, NastranInWhole)
{
  EXPECT_EQ(
    WriteFile(MakeTwoFaces(), ".bdf"),
    "$ Medial surface by MedialVoxel, lengths in the units of the image\nSOL 101\nCEND\nBEGIN BULK\n"
    "$ A placeholder (aluminum in N, mm, t): put in your material.\nMAT1,1,70000.,,.33,2.7-9\n"
    "PSHELL* 1               1               1.5             1               \n"
    "*                       1\n"
    "GRID*   1                               0.              0.              \n*       0.\n"
    "GRID*   2                               4.              0.              \n*       0.\n"
    "GRID*   3                               5.              3.              \n*       0.\n"
    "GRID*   4                               1.              1.5             \n*       0.\n"
    "GRID*   5                               -2.             0.              \n*       1.e-05\n"
    "CQUAD4  1       1       1       2       3       4       \nCTRIA3  2       1       1       4       5       \n"
    "ENDDATA\n");
}

TEST(SurfaceWriter, LongSetsHaveSixteenNumbersPerLine)
{
  const std::string text = WriteFile(MakeSquares(std::vector<double>(33, 1.0)), ".inp");
  const size_t      begin = text.find("*ELSET, ELSET=THICKNESS_1\n");
  const std::string expected = "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,\n"
                               "17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32,\n33\n*";
  EXPECT_EQ(text.substr(text.find('\n', begin) + 1, expected.size()), expected);
}

TEST(SurfaceWriter, StlSplitsQuadsAlongTheShorterDiagonal)
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

TEST(SurfaceWriter, StlOfATriangleWithoutAreaHasNoNormal)
{
  Surface surface = MakeTwoFaces();
  surface.faces = { MakeFace({ 0, 1, 0 }) };
  const std::string bytes = WriteFile(surface, ".stl");
  for (size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(GetFloat(bytes, 84 + 4 * axis), 0.0f);
  }
}

TEST(SurfaceWriter, LegacyVtkHasTheHighByteFirst)
{
  const std::string bytes = WriteFile(MakeTwoFaces(), ".vtk");
  // A quad is the number 4 and its corners.
  const std::string polygons("POLYGONS 2 9\n\0\0\0\4\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0\3", 33);
  EXPECT_NE(bytes.find(polygons), std::string::npos);
}

TEST(SurfaceWriter, CoordinatesAreFloat32InAllFormats)
{
  Surface surface = MakeTwoFaces();
  surface.vertices[0].position = { 1.0 / 3, -1e-9, 123456.789 };
  EXPECT_EQ(GetLinesAfter(WriteFile(surface, ".inp"), "*NODE").front(), "1, 0.33333334, -1e-09, 123456.79");
  const std::string nastran = WriteFile(surface, ".bdf");
  EXPECT_NE(
    nastran.find("GRID*   1                               0.33333334      -1.e-09         \n*       123456.79\n"),
    std::string::npos);
}

TEST(SurfaceWriter, CoordinatesAreFloat64WhereTheSurfaceNeedsIt)
{
  Surface surface = MakeTwoFaces();
  surface.vertices[0].position = { 20000000.1, -1.0 / 3, -20000000.123456789 };
  const auto write = [&](const std::string & extension) {
    return WriteFile(surface, extension, {}, 1000, SurfacePrecision::Double);
  };
  EXPECT_EQ(GetLinesAfter(write(".inp"), "*NODE").front(), "1, 20000000.1, -0.3333333333333333, -20000000.123456787");
  // As many digits as its fields hold.
  EXPECT_NE(write(".bdf").find("20000000.1      -0.3333333333333\n*       -20000000.123457\n"), std::string::npos);
  EXPECT_NE(write(".vtp").find("<DataArray type=\"Float64\" Name=\"Points\""), std::string::npos);
  EXPECT_NE(write(".vtu").find("<DataArray type=\"Float64\" Name=\"Points\""), std::string::npos);
  EXPECT_NE(write(".vtk").find("POINTS 5 double\n"), std::string::npos);
  EXPECT_NE(write(".ply").find("property double x\n"), std::string::npos);
}

TEST(SurfaceWriter, SectionsGoByTheNearestMultipleAndHaveTheMeanByArea)
{
  Surface surface = MakeSquares({ 2.0, 1.9, 2.1, 3.0, 2.12 });
  surface.faces[1].area = 3;
  SurfaceWriteOptions options;
  options.thicknessClassWidth = 0.25;
  const std::string text = WriteFile(surface, ".inp", options);
  EXPECT_EQ(GetLinesAfter(text, "*ELSET, ELSET=THICKNESS"), (std::vector<std::string>{ "1, 2, 3, 5", "4" }));
  // (2.0 + 3 * 1.9 + 2.1 + 2.12) / 6 = 1.98666...
  const std::vector<std::string> thicknesses = GetLinesAfter(text, "*SHELL SECTION");
  ASSERT_EQ(thicknesses.size(), 2U);
  EXPECT_NEAR(std::stod(thicknesses[0]), 11.92 / 6, 1e-6);
  EXPECT_EQ(thicknesses[1], "3");
}

TEST(SurfaceWriter, CornersWithoutThicknessDoNotCount)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Surface      surface = MakeSquares({ 1.0, nan, 3.0, 0.0 });
  surface.vertices[8].thickness = nan;
  const std::string text = WriteFile(surface, ".inp");
  // Sections: 1, 3, and the two squares without any, which get the mean of the others.
  EXPECT_EQ(GetLinesAfter(text, "*ELSET, ELSET=THICKNESS"), (std::vector<std::string>{ "1", "3", "2, 4" }));
  EXPECT_EQ(GetLinesAfter(text, "*SHELL SECTION"), (std::vector<std::string>{ "1", "3", "2" }));
  for (const char * extension : { ".inp", ".bdf" })
  {
    EXPECT_EQ(GetStatusOf([&] { WriteFile(MakeSquares({ nan, 0, -1 }), extension); }), ExitStatus::Failure);
  }
}

TEST(SurfaceWriter, CornersAtARimCountOnlyWithoutOthers)
{
  // A row of three squares: their corners at the outer sides are thin.
  Surface surface = MakeSquares({ 2.0, 2.0, 2.0 });
  surface.faces[0].rimEdges = 8;
  surface.vertices[0].thickness = 1.0;
  surface.vertices[3].thickness = 1.2;
  surface.faces[1].rimEdges = 0;
  surface.faces[2].rimEdges = 15;
  surface.vertices[8].thickness = 1.6;
  SurfaceWriteOptions options;
  options.thicknessClassWidth = 0.05;
  const std::string text = WriteFile(surface, ".inp", options);
  EXPECT_EQ(GetLinesAfter(text, "*ELSET, ELSET=THICKNESS"), (std::vector<std::string>{ "3", "1, 2" }));
  EXPECT_EQ(GetLinesAfter(text, "*SHELL SECTION"), (std::vector<std::string>{ "1.9", "2" }));
}

TEST(SurfaceWriter, BadQuadsBecomeTwoElements)
{
  struct Case
  {
    SurfaceVertex            third;
    std::vector<std::string> triangles;
  };
  // The third corner of a square moves along its diagonal: a good quad, one that is nearly a triangle, one turned in.
  const std::vector<Case> cases{ { { { 0.65, 0.65, 0 }, 1 }, {} },
                                 { { { 0.52, 0.52, 0 }, 1 }, { "1, 1, 2, 3", "2, 1, 3, 4" } },
                                 { { { 0.3, 0.3, 0 }, 1 }, { "1, 1, 2, 3", "2, 1, 3, 4" } } };
  for (const auto & [third, triangles] : cases)
  {
    Surface surface = MakeSquares({ 1.0 });
    surface.vertices[2] = third;
    const std::string text = WriteFile(surface, ".inp");
    EXPECT_EQ(GetLinesAfter(text, "*ELEMENT, TYPE=S4").size(), triangles.empty() ? 1U : 0U) << third.position[0];
    const size_t begin = text.find("*ELEMENT, TYPE=S3, ELSET=TRIANGLES\n");
    ASSERT_EQ(begin == std::string::npos, triangles.empty());
    if (!triangles.empty())
    {
      const size_t end = text.find("*ELSET", begin);
      EXPECT_EQ(text.substr(begin, end - begin),
                "*ELEMENT, TYPE=S3, ELSET=TRIANGLES\n" + triangles[0] + "\n" + triangles[1] + "\n");
      EXPECT_EQ(GetLinesAfter(text, "*ELSET, ELSET=THICKNESS"), std::vector<std::string>{ "1, 2" });
      EXPECT_NE(WriteFile(surface, ".bdf").find("CTRIA3  2       1       1       3       4"), std::string::npos);
    }
  }
  // The corner before it: split along the other diagonal.
  Surface surface = MakeSquares({ 1.0 });
  surface.vertices[1].position = { 0.4, 0.4, 0 };
  EXPECT_NE(WriteFile(surface, ".inp").find("\n1, 1, 2, 4\n2, 2, 3, 4\n"), std::string::npos);
}

TEST(SurfaceWriter, RefusesClassWidthsThatMakeNoSense)
{
  const Surface surface = MakeSquares({ 1.0, 2.0 });
  for (const double width : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    SurfaceWriteOptions options;
    options.thicknessClassWidth = width;
    EXPECT_EQ(GetStatusOf([&] { WriteFile(surface, ".inp", options); }), ExitStatus::Usage) << width;
    EXPECT_EQ(GetStatusOf([&] { WriteFile(surface, ".vtp", options); }), ExitStatus::Done) << width;
  }
  std::vector<double> thicknesses;
  for (int square = 0; square <= 10000; ++square)
  {
    thicknesses.push_back(1.0 + 1e-3 * square);
  }
  SurfaceWriteOptions options;
  options.thicknessClassWidth = 1e-4;
  EXPECT_EQ(GetStatusOf([&] { WriteFile(MakeSquares(thicknesses), ".bdf", options); }), ExitStatus::Refused);
  thicknesses.pop_back();
  EXPECT_EQ(GetStatusOf([&] { WriteFile(MakeSquares(thicknesses), ".bdf", options); }), ExitStatus::Done);
}

TEST(SurfaceWriter, RefusesMoreThanAFormatHolds)
{
  struct Case
  {
    SurfaceFormat format;
    std::uint64_t vertices;
    std::uint64_t triangles;
    std::uint64_t quads;
  };
  const std::uint64_t     int32 = std::numeric_limits<std::int32_t>::max();
  const std::uint64_t     uint32 = std::numeric_limits<std::uint32_t>::max();
  const std::vector<Case> largest{ { SurfaceFormat::Vtk, int32, 1, (int32 - 4) / 5 },
                                   { SurfaceFormat::Ply, int32, 7, int32 - 7 },
                                   { SurfaceFormat::Stl, uint32 * 2, 1, uint32 / 2 },
                                   { SurfaceFormat::Abaqus, 999999999, 9, 999999990 },
                                   { SurfaceFormat::Nastran, 99999999, 9, 99999990 } };
  for (const auto & [format, vertices, triangles, quads] : largest)
  {
    EXPECT_NO_THROW(CheckSurfaceFits(format, vertices, triangles, quads));
    EXPECT_EQ(
      GetStatusOf([&, f = format, v = vertices, t = triangles, q = quads] { CheckSurfaceFits(f, v, t, q + 1); }),
      ExitStatus::Refused);
    if (format != SurfaceFormat::Stl)
    {
      EXPECT_EQ(GetStatusOf([&, f = format, v = vertices] { CheckSurfaceFits(f, v + 1, 0, 0); }), ExitStatus::Refused);
    }
  }
  for (const SurfaceFormat format : { SurfaceFormat::Vtp, SurfaceFormat::Vtu, SurfaceFormat::Obj })
  {
    EXPECT_NO_THROW(CheckSurfaceFits(format, uint32 * 100, uint32, uint32 * 100));
  }
  try
  {
    CheckSurfaceFits(SurfaceFormat::Stl, 0, 2, uint32 / 2);
    FAIL() << "too many triangles";
  }
  catch (const JobError & error)
  {
    EXPECT_NE(std::string(error.what()).find("4294967295"), std::string::npos) << error.what();
  }
}

TEST(SurfaceWriter, NoticesAVertexThatIsMissing)
{
  Surface surface = MakeTwoFaces();
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

TEST(SurfaceWriter, AnEmptySurfaceIsAFile)
{
  for (const std::string & extension : Extensions)
  {
    EXPECT_FALSE(WriteFile(MakeSurface("empty"), extension).empty()) << extension;
  }
}

TEST(SurfaceWriter, ProgressRisesToOneAndMayStop)
{
  const Surface surface = MakeSquares(std::vector<double>(2000, 1.0));
  for (const std::string & extension : Extensions)
  {
    double              last = 0;
    SurfaceWriteOptions options;
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

TEST(SurfaceSpool, RefusesAFolderThatIsMissing)
{
  const TemporaryFolder folder;
  EXPECT_EQ(GetStatusOf([&] { SurfaceSpool spool(folder / "missing"); }), ExitStatus::Refused);
}

TEST(SurfaceSpool, RoundsToItsPrecision)
{
  const std::vector<SurfaceVertex> vertices(9, { { 1.0 / 3, -2.0 / 3, 20000000.1 }, 1.0 });
  for (const SurfacePrecision precision : { SurfacePrecision::Single, SurfacePrecision::Double })
  {
    const TemporaryFolder             folder;
    SurfaceSpool                      spool(folder / "", precision);
    std::vector<SurfaceSpool::Vertex> read;
    spool.AddVertices(vertices);
    spool.ReadVertices(0, vertices.size(), read);
    for (size_t i = 0; i < vertices.size(); ++i)
    {
      for (size_t axis = 0; axis < 3; ++axis)
      {
        const volatile float rounded = static_cast<float>(vertices[i].position[axis]);
        EXPECT_EQ(read[i].position[axis],
                  precision == SurfacePrecision::Single ? static_cast<double>(rounded) : vertices[i].position[axis]);
      }
    }
  }
}

TEST(SurfaceSpool, LeavesNoFile)
{
  const TemporaryFolder folder;
  SurfaceSpool          spool(folder / "");
  AddInPieces(MakeSurface("plate"), 3, spool);
  EXPECT_EQ(folder.GetNumberOfFiles(), 0);
  EXPECT_EQ(spool.GetNumberOfVertices(), 24U);
  EXPECT_EQ(spool.GetNumberOfFaces(), 15U);
}
