// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Branches of surfaces made of unit squares, and an oracle that looks at all faces for each question.

#include "itkMedialVoxelSurfaceStore.h"

#include "MedialVoxelTestSurface.h"

#include <random>
#include <set>

namespace
{
using namespace MedialVoxelTest;

using Side = std::pair<std::uint64_t, std::uint64_t>;
using Sides = std::array<Side, 4>;

Sides
SidesOf(const itk::MedialVoxelSurfaceQuad & quad)
{
  Sides sides;
  for (int k = 0; k < 4; ++k)
  {
    sides[k] = std::minmax(quad.vertices[k], quad.vertices[(k + 1) % 4]);
  }
  return sides;
}

/** The marks that follow from the faces alone. */
void
MarkSides(Surface & surface)
{
  const auto counts = CountSides(surface);
  for (auto & quad : surface.quads)
  {
    quad.rimSides = 0;
    quad.junctionSides = 0;
    for (int k = 0; k < 4; ++k)
    {
      const int count = counts.at(SidesOf(quad)[k]);
      quad.rimSides = static_cast<std::uint8_t>(quad.rimSides | (count == 1 ? 1 << k : 0));
      quad.junctionSides = static_cast<std::uint8_t>(quad.junctionSides | (count > 2 ? 1 << k : 0));
    }
  }
}

/** Unit squares of a lattice. */
class Squares
{
public:
  /** The one across an axis with this lowest corner. */
  void
  Add(int axis, Index3 corner)
  {
    m_Squares.push_back({ axis, corner });
  }

  /** Those across an axis with lowest corners from `from` to `to`, the latter left out along the other axes. */
  void
  AddSheet(int axis, const Index3 & from, const Index3 & to)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int i = from[u]; i < to[u]; ++i)
    {
      for (int j = from[v]; j < to[v]; ++j)
      {
        Index3 corner = from;
        corner[u] = i;
        corner[v] = j;
        this->Add(axis, corner);
      }
    }
  }

  Surface
  MakeSurface() const
  {
    Surface                         surface;
    std::map<Index3, std::uint64_t> numbers;
    for (const auto & [axis, corner] : m_Squares)
    {
      itk::MedialVoxelSurfaceQuad quad;
      for (int k = 0; k < 4; ++k)
      {
        Index3 position = corner;
        position[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
        position[(axis + 2) % 3] += k >= 2 ? 1 : 0;
        const auto [entry, isNew] = numbers.emplace(position, surface.vertices.size());
        quad.vertices[k] = entry->second;
        if (isNew)
        {
          surface.vertices.push_back({ { { double(position[0]), double(position[1]), double(position[2]) } }, 1.0 });
        }
      }
      surface.quads.push_back(quad);
    }
    MarkSides(surface);
    return surface;
  }

private:
  std::vector<std::pair<int, Index3>> m_Squares;
};

/** What a store makes of a surface without branches below a length. */
Surface
Cut(const Surface & surface, double length)
{
  itk::MedialVoxelSurfaceStore store(true);
  store.AddVertices(surface.vertices);
  store.AddQuads(surface.quads);
  store.RemoveBranches(length);
  Surface rest;
  store.HandOn(rest);
  return rest;
}

/** Faces as the positions of their corners. */
std::multiset<std::vector<Vector3>>
FacesOf(const Surface & surface)
{
  std::multiset<std::vector<Vector3>> faces;
  for (const auto & quad : surface.quads)
  {
    std::vector<Vector3> face;
    for (const std::uint64_t vertex : quad.vertices)
    {
      face.push_back(surface.vertices[vertex].point);
    }
    faces.insert(face);
  }
  return faces;
}

/** Vertices at which exactly one side is a junction. */
std::set<std::uint64_t>
EndsOf(const std::map<Side, int> & counts)
{
  std::map<std::uint64_t, int> junctions;
  for (const auto & side : counts)
  {
    junctions[side.first.first] += side.second > 2 ? 1 : 0;
    junctions[side.first.second] += side.second > 2 ? 1 : 0;
  }
  std::set<std::uint64_t> ends;
  for (const auto & vertex : junctions)
  {
    if (vertex.second == 1)
    {
      ends.insert(vertex.first);
    }
  }
  return ends;
}

/** Numbers of the sheets of the faces: the smallest number spreads over sides of two faces. */
std::vector<std::size_t>
SheetsOf(const Surface & surface)
{
  const auto               counts = CountSides(surface);
  const auto               ends = EndsOf(counts);
  std::vector<std::size_t> sheets(surface.quads.size());
  for (std::size_t i = 0; i < sheets.size(); ++i)
  {
    sheets[i] = i;
  }
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    std::map<Side, std::size_t> lowest;
    for (int pass = 0; pass < 2; ++pass)
    {
      for (std::size_t i = 0; i < sheets.size(); ++i)
      {
        for (const Side & side : SidesOf(surface.quads[i]))
        {
          if (counts.at(side) == 2 && ends.count(side.first) + ends.count(side.second) == 0)
          {
            auto & number = lowest.emplace(side, sheets[i]).first->second;
            isChanged = isChanged || number != sheets[i];
            number = sheets[i] = std::min(number, sheets[i]);
          }
        }
      }
    }
  }
  return sheets;
}

/** Distances to the nearest junction. */
std::vector<double>
DistancesOf(const Surface & surface)
{
  std::vector<double> distances(surface.vertices.size(), 1e9);
  for (const auto & side : CountSides(surface))
  {
    if (side.second > 2)
    {
      distances[side.first.first] = distances[side.first.second] = 0.0;
    }
  }
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    for (const auto & quad : surface.quads)
    {
      for (const auto a : quad.vertices)
      {
        for (const auto b : quad.vertices)
        {
          const Vector3 & p = surface.vertices[a].point;
          const Vector3 & q = surface.vertices[b].point;
          const double    sum = distances[a] + std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
          if (sum < distances[b] - 1e-9)
          {
            distances[b] = sum;
            isChanged = true;
          }
        }
      }
    }
  }
  return distances;
}

/** Whether the junctions of a sheet hang together. */
bool
IsOneJunction(std::set<Side> sides)
{
  std::set<std::uint64_t> reached{ sides.begin()->first };
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    for (const Side & side : sides)
    {
      if (reached.count(side.first) != reached.count(side.second))
      {
        reached.insert({ side.first, side.second });
        isChanged = true;
      }
    }
  }
  return std::all_of(sides.begin(), sides.end(), [&](const Side & side) { return reached.count(side.first) > 0; });
}

/** The surface without branches, by definition. */
Surface
CutByDefinition(const Surface & surface, double length)
{
  const auto            counts = CountSides(surface);
  const auto            sheets = SheetsOf(surface);
  const auto            distances = DistancesOf(surface);
  std::set<std::size_t> branches;
  for (const std::size_t sheet : std::set<std::size_t>(sheets.begin(), sheets.end()))
  {
    bool           hasRim = false;
    bool           isShort = true;
    std::set<Side> junctions;
    for (std::size_t i = 0; i < sheets.size(); ++i)
    {
      for (int k = 0; k < 4 && sheets[i] == sheet; ++k)
      {
        const Side side = SidesOf(surface.quads[i])[k];
        isShort = isShort && distances[side.first] < length && distances[side.second] < length;
        hasRim = hasRim || counts.at(side) == 1;
        if (counts.at(side) > 2)
        {
          junctions.insert(side);
        }
      }
    }
    if (hasRim && isShort && !junctions.empty() && IsOneJunction(junctions))
    {
      branches.insert(sheet);
    }
  }
  Surface rest;
  rest.vertices = surface.vertices;
  for (std::size_t i = 0; i < sheets.size(); ++i)
  {
    if (branches.count(sheets[i]) == 0)
    {
      rest.quads.push_back(surface.quads[i]);
    }
  }
  return rest;
}

/** The marks are those of the faces that are left, and every vertex is used. */
void
ExpectWhole(Surface surface)
{
  const Surface before = surface;
  MarkSides(surface);
  std::vector<bool> isUsed(surface.vertices.size(), false);
  for (std::size_t i = 0; i < surface.quads.size(); ++i)
  {
    EXPECT_EQ(before.quads[i].rimSides, surface.quads[i].rimSides) << i;
    EXPECT_EQ(before.quads[i].junctionSides, surface.quads[i].junctionSides) << i;
    for (const std::uint64_t vertex : surface.quads[i].vertices)
    {
      isUsed.at(vertex) = true;
    }
  }
  EXPECT_TRUE(std::all_of(isUsed.begin(), isUsed.end(), [](bool used) { return used; }));
}

/** A plate of 12 by 6 with a rib of 3 in its middle. */
Squares
Tee()
{
  Squares squares;
  squares.AddSheet(2, { { 0, 0, 0 } }, { { 12, 6, 0 } });
  squares.AddSheet(0, { { 6, 0, 0 } }, { { 6, 6, 3 } });
  return squares;
}
} // namespace

TEST(MedialVoxelSurfaceBranches, AShortRibGoesAndThePlateIsOneSheet)
{
  const Surface tee = Tee().MakeSurface();
  Squares       plate;
  plate.AddSheet(2, { { 0, 0, 0 } }, { { 12, 6, 0 } });
  const Surface rest = Cut(tee, 3.5);
  EXPECT_EQ(FacesOf(rest), FacesOf(plate.MakeSurface()));
  ExpectWhole(rest);
  EXPECT_EQ(rest.quads.front().junctionSides, 0);
}

TEST(MedialVoxelSurfaceBranches, TheLengthIsThatOfTheFarthestVertex)
{
  const Surface tee = Tee().MakeSurface();
  EXPECT_EQ(Cut(tee, 3.0).quads.size(), tee.quads.size()) << "a branch as long as the length stays";
  EXPECT_EQ(Cut(tee, std::nextafter(3.0f, 4.0f)).quads.size(), 72u);
  EXPECT_EQ(Cut(tee, 6.0).quads.size(), 72u);
  EXPECT_TRUE(Cut(tee, 6.5).quads.empty()) << "all sheets of the junction are short";
}

TEST(MedialVoxelSurfaceBranches, ARoughRimDoesNotJoinARibToItsPlate)
{
  // The plate lacks a square beside the end of the rib, so that the junction ends a side before the rim.
  Squares rough;
  rough.AddSheet(2, { { 0, 0, 0 } }, { { 6, 6, 0 } });
  rough.AddSheet(2, { { 6, 0, 0 } }, { { 12, 5, 0 } });
  rough.AddSheet(0, { { 6, 0, 0 } }, { { 6, 6, 3 } });
  const Surface surface = rough.MakeSurface();
  const Surface rest = Cut(surface, 3.5);
  EXPECT_EQ(rest.quads.size(), surface.quads.size() - 18);
  ExpectWhole(rest);
  // By two sides they are one.
  Squares rougher;
  rougher.AddSheet(2, { { 0, 0, 0 } }, { { 6, 6, 0 } });
  rougher.AddSheet(2, { { 6, 0, 0 } }, { { 12, 4, 0 } });
  rougher.AddSheet(0, { { 6, 0, 0 } }, { { 6, 6, 3 } });
  const Surface joined = rougher.MakeSurface();
  EXPECT_EQ(Cut(joined, 3.5).quads.size(), joined.quads.size());
}

TEST(MedialVoxelSurfaceBranches, ABendHasNone)
{
  Squares bend;
  bend.AddSheet(2, { { 0, 0, 0 } }, { { 5, 4, 0 } });
  bend.AddSheet(0, { { 0, 0, 0 } }, { { 0, 4, 2 } });
  const Surface surface = bend.MakeSurface();
  EXPECT_EQ(FacesOf(Cut(surface, 100.0)), FacesOf(surface));
}

TEST(MedialVoxelSurfaceBranches, AWebBetweenTwoPlatesStays)
{
  Squares beam;
  for (const int z : { 0, 2 })
  {
    beam.AddSheet(2, { { 0, 0, z } }, { { 12, 6, z } });
  }
  beam.AddSheet(0, { { 6, 0, 0 } }, { { 6, 6, 2 } });
  const Surface apart = beam.MakeSurface();
  EXPECT_EQ(Cut(apart, 4.0).quads.size(), apart.quads.size());
  // A wall at its end connects both of its junctions.
  beam.AddSheet(1, { { 0, 6, 0 } }, { { 12, 6, 2 } });
  const Surface joined = beam.MakeSurface();
  EXPECT_EQ(Cut(joined, 4.0).quads.size(), joined.quads.size() - 12);
}

TEST(MedialVoxelSurfaceBranches, ASheetWithoutRimStays)
{
  Squares bubble = Tee();
  // A closed box on the plate.
  bubble.AddSheet(2, { { 1, 1, 1 } }, { { 3, 3, 1 } });
  bubble.AddSheet(0, { { 1, 1, 0 } }, { { 1, 3, 1 } });
  bubble.AddSheet(0, { { 3, 1, 0 } }, { { 3, 3, 1 } });
  bubble.AddSheet(1, { { 1, 1, 0 } }, { { 3, 1, 1 } });
  bubble.AddSheet(1, { { 1, 3, 0 } }, { { 3, 3, 1 } });
  const Surface surface = bubble.MakeSurface();
  const Surface rest = Cut(surface, 3.5);
  EXPECT_EQ(rest.quads.size(), surface.quads.size() - 18);
  ExpectWhole(rest);
}

TEST(MedialVoxelSurfaceBranches, RandomSurfacesAreCutAsTheDefinitionSays)
{
  std::mt19937 generator(72);
  std::size_t  branches = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    Squares      squares;
    const double share = 0.25 + 0.01 * trial;
    for (int i = 0; i < 3 * 125; ++i)
    {
      if (generator() < share * 4294967296.0)
      {
        squares.Add(i % 3, { { i / 3 % 5, i / 15 % 5, i / 75 } });
      }
    }
    Surface       surface = squares.MakeSurface();
    const double  length = 0.6 + 0.0713 * trial;
    const Surface expected = CutByDefinition(surface, length);
    const Surface rest = Cut(surface, length);
    EXPECT_EQ(FacesOf(rest), FacesOf(expected)) << trial;
    ExpectWhole(rest);
    branches += rest.quads.size() < surface.quads.size() ? 1 : 0;

    std::shuffle(surface.quads.begin(), surface.quads.end(), generator);
    EXPECT_EQ(FacesOf(Cut(surface, length)), FacesOf(expected)) << "in another order, " << trial;
  }
  EXPECT_GT(branches, 20u);
}
