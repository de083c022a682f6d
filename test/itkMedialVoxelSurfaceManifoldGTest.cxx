// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestManifold.h"
#include "MedialVoxelTestSmallParts.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace
{
using namespace MedialVoxelTest;

constexpr unsigned int NumberOfParts = 1000;

/** What was wrong with surfaces, as numbers of parts. */
struct Failures
{
  unsigned int parts{ 0 };
  unsigned int edges{ 0 };    ///< with more than two faces where no sheets meet
  unsigned int fans{ 0 };     ///< with a vertex of several fans there
  unsigned int faces{ 0 };    ///< with a face twice, or one that names a vertex twice
  unsigned int fins{ 0 };     ///< with a face that hangs at others by one side
  unsigned int euler{ 0 };    ///< with another Euler number
  unsigned int meetings{ 0 }; ///< whose sheets do not meet all along their junction
};

/** One of a number of parts, all kinds in turn, with a fixed and an automatic thickness. */
void
CountFailures(unsigned int number, bool isAutomatic, Failures & failures)
{
  const auto      kind = static_cast<PartKind>(number % SmallParts::NumberOfKinds);
  SmallParts      parts(number);
  const SmallPart part = parts.Make(kind);
  // A threshold that is too small for a wall has sheets towards the edges of its rims.
  const double  tau = std::max(3.0, part.thickness) + parts.Between(0.0, 1.5);
  const auto    parameters = isAutomatic ? AutomaticThickness() : FixedThickness(tau);
  const Surface surface = MakeSurface(SmallParts::Fill(part), parameters);
  ASSERT_FALSE(surface.quads.empty());
  const ManifoldFaults faults = FindManifoldFaults(surface);
  const auto           isAway = [&](const Vector3 & point) { return !part.mayMeet || !part.mayMeet(point); };
  const bool           hasEdges = std::any_of(faults.edges.begin(), faults.edges.end(), isAway);
  const bool           hasFans = std::any_of(faults.fans.begin(), faults.fans.end(), isAway);
  const bool           hasEuler = kind == PartKind::HollowBox || kind == PartKind::Union;
  const bool           isOtherEuler = !hasEuler && EulerNumber(surface) != part.euler;
  ++failures.parts;
  failures.edges += hasEdges ? 1 : 0;
  failures.fans += hasFans ? 1 : 0;
  failures.faces += faults.repeatedFaces + faults.brokenFaces > 0 ? 1 : 0;
  failures.fins += faults.fins > 0 ? 1 : 0;
  failures.euler += isOtherEuler ? 1 : 0;
  const bool meetsTooLittle = static_cast<double>(faults.edges.size()) < part.lengthOfMeetings;
  failures.meetings += meetsTooLittle ? 1 : 0;
  if (hasEdges || hasFans || isOtherEuler || faults.fins > 0 || meetsTooLittle)
  {
    std::printf("part %u, %s, %s: edges away %d, fans away %d, fins %zu, Euler number %ld, meetings %zu\n",
                number,
                part.name.c_str(),
                isAutomatic ? "automatic" : "fixed",
                hasEdges ? 1 : 0,
                hasFans ? 1 : 0,
                faults.fins,
                EulerNumber(surface),
                faults.edges.size());
  }
}
} // namespace

TEST(MedialVoxelSurfaceManifold, SmallPartsAreManifoldsAwayFromJunctions)
{
  Failures fixed;
  Failures automatic;
  for (unsigned int number = 0; number < NumberOfParts; ++number)
  {
    // By turns of all kinds.
    const bool isAutomatic = number / SmallParts::NumberOfKinds % 2 != 0;
    CountFailures(number, isAutomatic, isAutomatic ? automatic : fixed);
  }
  for (const Failures & failures : { fixed, automatic })
  {
    EXPECT_GT(failures.parts, 400u);
    EXPECT_EQ(failures.edges, 0u);
    EXPECT_EQ(failures.fans, 0u);
    EXPECT_EQ(failures.faces, 0u);
    EXPECT_EQ(failures.fins, 0u);
    EXPECT_EQ(failures.meetings, 0u);
  }
  EXPECT_EQ(fixed.euler, 0u);
  EXPECT_LE(automatic.euler, 1u);
}

TEST(MedialVoxelSurfaceManifold, TheCheckerFindsWhatIsWrong)
{
  const auto make = [](const std::vector<std::array<std::uint64_t, 4>> & faces) {
    Surface surface;
    for (const auto & face : faces)
    {
      itk::MedialVoxelSurfaceQuad quad;
      quad.vertices = face;
      surface.quads.push_back(quad);
      surface.vertices.resize(
        std::max<std::size_t>(surface.vertices.size(), *std::max_element(face.begin(), face.end()) + 1));
    }
    return surface;
  };
  EXPECT_TRUE(FindManifoldFaults(make({ { { 0, 1, 2, 3 } }, { { 1, 4, 5, 2 } } })).IsManifold());
  // Three faces at an edge, of which one hangs there; two at a vertex alone; one twice; one with a vertex twice.
  const auto atEdge = FindManifoldFaults(make({ { { 0, 1, 2, 3 } }, { { 1, 4, 5, 2 } }, { { 1, 6, 7, 2 } } }));
  EXPECT_EQ(atEdge.edges.size(), 1u);
  EXPECT_EQ(atEdge.fins, 3u);
  EXPECT_EQ(FindManifoldFaults(make({ { { 0, 1, 2, 3 } }, { { 2, 4, 5, 6 } } })).fans.size(), 1u);
  EXPECT_EQ(FindManifoldFaults(make({ { { 0, 1, 2, 3 } }, { { 0, 1, 2, 3 } } })).repeatedFaces, 1u);
  EXPECT_EQ(FindManifoldFaults(make({ { { 0, 1, 1, 3 } } })).brokenFaces, 1u);
  EXPECT_EQ(EulerNumber(make({ { { 0, 1, 2, 3 } }, { { 1, 4, 5, 2 } } })), 1);
}
