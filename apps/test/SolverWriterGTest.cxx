// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshWriting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace medialvoxel;

TEST(SolverWriter, AbaqusInWhole)
{
  // The quad has the thickness 1.5 and the triangle too, so they share a section.
  EXPECT_EQ(WriteFile(MakeTwoFaces(), ".inp"),
            "*HEADING\nMedial surface by MedialVoxel, coordinates and thickness in units of the spacing\n"
            "*NODE, NSET=ALL_NODES\n"
            "1, 0, 0, 0\n2, 4, 0, 0\n3, 5, 3, 0\n4, 1, 1.5, 0\n5, -2, 0, 1e-05\n"
            "*ELEMENT, TYPE=S3, ELSET=TRIANGLES\n2, 1, 4, 5\n*ELEMENT, TYPE=S4, ELSET=QUADS\n1, 1, 2, 3, 4\n"
            "*ELSET, ELSET=THICKNESS_1\n1, 2\n"
            "** RIM and JUNCTION are sets of nodes and of elements; of those in RIM_E1, side E1 is at a rim.\n"
            "*NSET, NSET=RIM\n1, 2, 3, 4\n*ELSET, ELSET=RIM\n1\n"
            "*ELSET, ELSET=RIM_E1\n1\n*ELSET, ELSET=RIM_E2\n1\n*ELSET, ELSET=RIM_E3\n1\n"
            "*NSET, NSET=JUNCTION\n4, 5\n*ELSET, ELSET=JUNCTION\n2\n*ELSET, ELSET=JUNCTION_E2\n2\n"
            "**\n** A placeholder (aluminum in N, mm, t): put in your material.\n"
            "*MATERIAL, NAME=REPLACE_THIS_MATERIAL\n*ELASTIC\n70000., 0.33\n*DENSITY\n2.7e-9\n"
            "*SHELL SECTION, ELSET=THICKNESS_1, MATERIAL=REPLACE_THIS_MATERIAL\n1.5\n");
}

TEST(SolverWriter, NastranInWhole)
{
  EXPECT_EQ(
    WriteFile(MakeTwoFaces(), ".bdf"),
    "$ Medial surface by MedialVoxel, coordinates and thickness in units of the spacing\nSOL 101\nCEND\n"
    "$ Set 1: nodes of RIM\nSET 1 = 1,2,3,4\n$ Set 2: nodes of JUNCTION\nSET 2 = 4,5\nBEGIN BULK\n"
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

TEST(SolverWriter, LsDynaInWhole)
{
  EXPECT_EQ(WriteFile(MakeTwoFaces(), ".k"),
            "*KEYWORD\n*TITLE\nMedial surface by MedialVoxel, coordinates and thickness in units of the spacing\n"
            "$ A placeholder (aluminum in N, mm, t): put in your material.\n"
            "*MAT_ELASTIC\n$      mid        ro         e        pr\n1         2.7e-9    70000.    0.33\n"
            "*PART\nTHICKNESS_1\n$      pid     secid       mid\n1         1         1         \n"
            "*SECTION_SHELL\n$    secid    elform      shrf       nip\n1         16        0.833333  5         \n"
            "$       t1        t2        t3        t4\n1.5       1.5       1.5       1.5       \n"
            "*NODE\n$  nid               x               y               z\n"
            "1       0.              0.              0.              \n"
            "2       4.              0.              0.              \n"
            "3       5.              3.              0.              \n"
            "4       1.              1.5             0.              \n"
            "5       -2.             0.              1.e-05          \n"
            "*ELEMENT_SHELL\n$  eid     pid      n1      n2      n3      n4\n"
            "1       1       1       2       3       4       \n2       1       1       4       5       5       \n"
            "*SET_NODE_LIST_TITLE\nRIM\n1         \n1         2         3         4         \n"
            "*SET_NODE_LIST_TITLE\nJUNCTION\n2         \n4         5         \n"
            "*SET_SHELL_LIST_TITLE\nRIM\n1         \n1         \n"
            "*SET_SHELL_LIST_TITLE\nJUNCTION\n2         \n2         \n*END\n");
}

TEST(SolverWriter, WallsAreSets)
{
  // A quad that becomes two elements, one without a wall, and a wall of two faces; wall 2 has none.
  TestMesh surface = MakeSquares({ 1.0, 1.0, 1.0, 1.0 });
  surface.vertices[2].position = { 0.3, 0.3, 0 };
  surface.faces[0].wall = 3;
  surface.faces[2].wall = 1;
  surface.faces[3].wall = 3;
  for (const std::uint64_t keptNumbers : { std::uint64_t{ 1 } << 22, std::uint64_t{ 3 }, std::uint64_t{ 1 } })
  {
    MeshWriteOptions options;
    options.hasWalls = true;
    options.keptNumbers = keptNumbers;
    std::string text = WriteFile(surface, ".inp", options);
    EXPECT_NE(text.find("*ELSET, ELSET=WALL_1\n4\n*ELSET, ELSET=WALL_3\n1, 2, 5\n**\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("WALL_2"), std::string::npos);
    text = WriteFile(surface, ".bdf", options);
    EXPECT_NE(text.find("$ Set 1001: elements of WALL_1\nSET 1001 = 4\n"
                        "$ Set 1003: elements of WALL_3\nSET 1003 = 1,2,5\nBEGIN BULK\n"),
              std::string::npos)
      << text;
    text = WriteFile(surface, ".k", options);
    EXPECT_NE(text.find("*SET_SHELL_LIST_TITLE\nWALL_1\n1001      \n4         \n"
                        "*SET_SHELL_LIST_TITLE\nWALL_3\n1003      \n1         2         5         \n*END\n"),
              std::string::npos)
      << text;
  }
  EXPECT_EQ(WriteFile(surface, ".inp").find("WALL"), std::string::npos);
}

TEST(SolverWriter, ThicknessAtNodes)
{
  // Three squares in a row whose ends are rims; walls are 2 at the left, 3 at the right.
  TestMesh surface;
  for (int x = 0; x < 4; ++x)
  {
    const double thickness = x < 2 ? 2.0 : 3.0;
    const bool   isAtEnd = x == 0 || x == 3;
    surface.vertices.push_back({ { 1.0 * x, 0, 0 }, isAtEnd ? 0.5 : thickness });
    surface.vertices.push_back({ { 1.0 * x, 1, 0 }, isAtEnd ? 0.5 : thickness });
  }
  surface.faces = { MakeFace({ 0, 2, 3, 1 }), MakeFace({ 2, 4, 5, 3 }), MakeFace({ 4, 6, 7, 5 }) };
  surface.faces[0].rimEdges = 8;
  surface.faces[2].rimEdges = 2;
  MeshWriteOptions options;
  options.thicknessPlace = ThicknessPlace::Nodes;
  std::string text = WriteFile(surface, ".inp", options);
  EXPECT_NE(text.find("*NODAL THICKNESS\n1, 2\n2, 2\n3, 2\n4, 2\n5, 3\n6, 3\n7, 3\n8, 3\n"), std::string::npos);
  EXPECT_NE(text.find("ELSET=THICKNESS_1, MATERIAL=REPLACE_THIS_MATERIAL, NODAL THICKNESS\n2.5\n"), std::string::npos);
  for (const std::uint64_t keptNumbers : { 1, 12 })
  {
    MeshWriteOptions few = options;
    few.keptNumbers = keptNumbers;
    EXPECT_EQ(WriteFile(surface, ".inp", few), text);
  }
  text = WriteFile(surface, ".bdf", options);
  EXPECT_NE(text.find("CQUAD4  2       1       3       5       6       4       \n"
                      "                        2.      3.      3.      2.      \n"),
            std::string::npos);
  text = WriteFile(surface, ".k", options);
  EXPECT_NE(text.find("3       1       5       7       8       6       \n"
                      "3.              3.              3.              3.              \n"),
            std::string::npos);
}

TEST(SolverWriter, SmallFieldsOfNastranHaveFourDigitsAtLeast)
{
  MeshWriteOptions options;
  options.thicknessPlace = ThicknessPlace::Nodes;
  for (const auto & [thickness, field] : { std::pair(1.0, "1.      "),
                                           std::pair(3.1415927, "3.141593"),
                                           std::pair(0.012345678, "1.2346-2"),
                                           std::pair(1.2345678e-10, "1.235-10"),
                                           std::pair(123456789.0, "1.2346+8") })
  {
    EXPECT_NE(WriteFile(MakeSquares({ thickness }), ".bdf", options).find(field + std::string(field)),
              std::string::npos)
      << thickness;
  }
}

TEST(SolverWriter, NodesWithoutThicknessHaveTheMean)
{
  TestMesh surface = MakeSquares({ 2.0, std::nan("") });
  for (MeshFace & face : surface.faces)
  {
    face.rimEdges = 0;
  }
  surface.vertices[1].thickness = 0;
  MeshWriteOptions options;
  options.thicknessPlace = ThicknessPlace::Nodes;
  EXPECT_NE(WriteFile(surface, ".inp", options).find("\n1, 2\n2, 2\n3, 2\n4, 2\n5, 2\n6, 2\n7, 2\n8, 2\n"),
            std::string::npos);
  EXPECT_EQ(GetStatusOf([&] { WriteFile(MakeSquares({ 0.0 }), ".k", options); }), ExitStatus::Failure);
}

TEST(SolverWriter, SidesOfSplitQuads)
{
  // The quad becomes the triangles 1, 2, 3 and 1, 3, 4; its second and third side are rims.
  TestMesh surface = MakeSquares({ 1.0 });
  surface.vertices[2] = { { 0.3, 0.3, 0 }, 1 };
  surface.faces[0].rimEdges = 6;
  const std::string text = WriteFile(surface, ".inp");
  EXPECT_EQ(GetLinesAfter(text, "*ELSET, ELSET=RIM"), (std::vector<std::string>{ "1, 2", "1, 2" }));
  EXPECT_NE(text.find("*ELSET, ELSET=RIM_E2\n1, 2\n"), std::string::npos);
}

TEST(SolverWriter, LongSetsHaveSixteenNumbersPerLine)
{
  const std::string text = WriteFile(MakeSquares(std::vector<double>(33, 1.0)), ".inp");
  const size_t      begin = text.find("*ELSET, ELSET=THICKNESS_1\n");
  const std::string expected = "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,\n"
                               "17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32,\n33\n*";
  EXPECT_EQ(text.substr(text.find('\n', begin) + 1, expected.size()), expected);
}

TEST(SolverWriter, SectionsGoByTheNearestMultipleAndHaveTheMeanByArea)
{
  TestMesh surface = MakeSquares({ 2.0, 1.9, 2.1, 3.0, 2.12 });
  surface.faces[1].area = 3;
  MeshWriteOptions options;
  options.thicknessClassWidth = 0.25;
  const std::string text = WriteFile(surface, ".inp", options);
  EXPECT_EQ(GetLinesAfter(text, "*ELSET, ELSET=THICKNESS"), (std::vector<std::string>{ "1, 2, 3, 5", "4" }));
  // (2.0 + 3 * 1.9 + 2.1 + 2.12) / 6 = 1.98666...
  const std::vector<std::string> thicknesses = GetLinesAfter(text, "*SHELL SECTION");
  ASSERT_EQ(thicknesses.size(), 2U);
  EXPECT_NEAR(std::stod(thicknesses[0]), 11.92 / 6, 1e-6);
  EXPECT_EQ(thicknesses[1], "3");
}

TEST(SolverWriter, CornersWithoutThicknessDoNotCount)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TestMesh     surface = MakeSquares({ 1.0, nan, 3.0, 0.0 });
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

TEST(SolverWriter, CornersAtARimCountOnlyWithoutOthers)
{
  // A row of three squares: their corners at the outer sides are thin.
  TestMesh surface = MakeSquares({ 2.0, 2.0, 2.0 });
  surface.faces[0].rimEdges = 8;
  surface.vertices[0].thickness = 1.0;
  surface.vertices[3].thickness = 1.2;
  surface.faces[1].rimEdges = 0;
  surface.faces[2].rimEdges = 15;
  surface.vertices[8].thickness = 1.6;
  MeshWriteOptions options;
  options.thicknessClassWidth = 0.05;
  const std::string text = WriteFile(surface, ".inp", options);
  EXPECT_EQ(GetLinesAfter(text, "*ELSET, ELSET=THICKNESS"), (std::vector<std::string>{ "3", "1, 2" }));
  EXPECT_EQ(GetLinesAfter(text, "*SHELL SECTION"), (std::vector<std::string>{ "1.9", "2" }));
}

TEST(SolverWriter, BadQuadsBecomeTwoElements)
{
  struct Case
  {
    MeshVertex               third;
    std::vector<std::string> triangles;
  };
  // The third corner of a square moves along its diagonal: a good quad, one that is nearly a triangle, one turned in.
  const std::vector<Case> cases{ { { { 0.65, 0.65, 0 }, 1 }, {} },
                                 { { { 0.52, 0.52, 0 }, 1 }, { "1, 1, 2, 3", "2, 1, 3, 4" } },
                                 { { { 0.3, 0.3, 0 }, 1 }, { "1, 1, 2, 3", "2, 1, 3, 4" } } };
  for (const auto & [third, triangles] : cases)
  {
    TestMesh surface = MakeSquares({ 1.0 });
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
  TestMesh surface = MakeSquares({ 1.0 });
  surface.vertices[1].position = { 0.4, 0.4, 0 };
  EXPECT_NE(WriteFile(surface, ".inp").find("\n1, 1, 2, 4\n2, 2, 3, 4\n"), std::string::npos);
}

TEST(SolverWriter, RefusesClassWidthsThatMakeNoSense)
{
  const TestMesh surface = MakeSquares({ 1.0, 2.0 });
  for (const double width : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    MeshWriteOptions options;
    options.thicknessClassWidth = width;
    EXPECT_EQ(GetStatusOf([&] { WriteFile(surface, ".inp", options); }), ExitStatus::Usage) << width;
    EXPECT_EQ(GetStatusOf([&] { WriteFile(surface, ".vtp", options); }), ExitStatus::Done) << width;
  }
  std::vector<double> thicknesses;
  for (int square = 0; square <= 10000; ++square)
  {
    thicknesses.push_back(1.0 + 1e-3 * square);
  }
  MeshWriteOptions options;
  options.thicknessClassWidth = 1e-4;
  EXPECT_EQ(GetStatusOf([&] { WriteFile(MakeSquares(thicknesses), ".bdf", options); }), ExitStatus::Refused);
  thicknesses.pop_back();
  EXPECT_EQ(GetStatusOf([&] { WriteFile(MakeSquares(thicknesses), ".bdf", options); }), ExitStatus::Done);
}
