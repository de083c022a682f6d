// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelIsosurface.h"
#include "itkMedialVoxelIsosurfaceTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>

namespace
{

using Table = itk::MedialVoxelIsosurfaceTable;
using Index = itk::MedialVoxelIndex;
using Side = std::pair<std::uint64_t, std::uint64_t>;

/** Takes a surface into memory. */
class Collector : public itk::MedialVoxelIsosurfaceConsumer
{
public:
  void
  AddVertices(const std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceVertex> & vertices) override
  {
    Put(first, vertices, m_Vertices);
  }

  void
  AddTriangles(const std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceTriangle> & triangles) override
  {
    Put(first, triangles, m_Triangles);
  }

  std::vector<itk::MedialVoxelIsosurfaceVertex>   m_Vertices;
  std::vector<itk::MedialVoxelIsosurfaceTriangle> m_Triangles;

private:
  template <typename TRecord>
  static void
  Put(const std::uint64_t first, const std::vector<TRecord> & records, std::vector<TRecord> & all)
  {
    all.resize(std::max<std::size_t>(all.size(), first + records.size()));
    std::copy(records.begin(), records.end(), all.begin() + static_cast<std::ptrdiff_t>(first));
  }
};

/** The last task first. */
void
RunBackwards(const std::size_t count, const std::function<void(std::size_t number)> & task)
{
  for (std::size_t number = count; number-- > 0;)
  {
    task(number);
  }
}

/** The surface of voxels for which margin(x, y, z) is not negative. */
template <typename TMargin>
Collector
Build(const Index & size, bool isClosed, const TMargin & margin)
{
  Collector                  collector;
  itk::MedialVoxelMargins    margins(size, 2);
  itk::MedialVoxelIsosurface surface(margins, isClosed, collector, RunBackwards);
  for (std::int64_t z = 0; z < size[2]; ++z)
  {
    itk::MedialVoxelBits bits({ { 0, 0, z }, { size[0], size[1], z + 1 } });
    for (std::int64_t y = 0; y < size[1]; ++y)
    {
      for (std::int64_t x = 0; x < size[0]; ++x)
      {
        margins.GetRow(y, z)[x] = margin(x, y, z);
        if (margin(x, y, z) >= 0.0f)
        {
          bits.Set({ x, y, z });
        }
      }
    }
    surface.AddSlice(bits);
  }
  surface.Finish();
  return collector;
}

/** How often each side is walked along in its direction. */
std::map<Side, int>
CountSides(const Collector & surface)
{
  std::map<Side, int> sides;
  for (const auto & triangle : surface.m_Triangles)
  {
    for (unsigned int i = 0; i < 3; ++i)
    {
      ++sides[{ triangle.vertices[i], triangle.vertices[(i + 1) % 3] }];
    }
  }
  return sides;
}

void
ExpectClosed(const Collector & surface)
{
  const auto sides = CountSides(surface);
  for (const auto & [side, count] : sides)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({ side.second, side.first }), 1u);
  }
}

double
GetVolume(const Collector & surface)
{
  double volume = 0.0;
  for (const auto & triangle : surface.m_Triangles)
  {
    const auto & a = surface.m_Vertices[triangle.vertices[0]].point;
    const auto & b = surface.m_Vertices[triangle.vertices[1]].point;
    const auto & c = surface.m_Vertices[triangle.vertices[2]].point;
    volume +=
      (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
      6.0;
  }
  return volume;
}

TEST(MedialVoxelIsosurfaceTable, HasTrianglesForAllCorners)
{
  std::size_t most = 0;
  for (unsigned int corners = 0; corners < 256; ++corners)
  {
    const auto & triangles = Table::Get(corners);
    EXPECT_EQ(triangles.empty(), corners == 0 || corners == 255);
    std::set<unsigned int> crossed;
    for (unsigned int edge = 0; edge < Table::NumberOfEdges; ++edge)
    {
      const unsigned int lower = Table::GetLowerCorner(edge);
      const unsigned int upper = lower | 1u << Table::GetAxis(edge);
      if ((corners >> lower & 1u) != (corners >> upper & 1u))
      {
        crossed.insert(edge);
      }
    }
    std::set<unsigned int> used;
    for (const auto & triangle : triangles)
    {
      used.insert(triangle.begin(), triangle.end());
    }
    EXPECT_EQ(used, crossed) << corners;
    most = std::max(most, triangles.size());
  }
  EXPECT_EQ(most, 5u);
}

TEST(MedialVoxelIsosurface, OfNoiseIsClosedWithTwoFacesAtEachSide)
{
  const Index                           size{ 67, 9, 8 };
  std::mt19937                          draw(7);
  std::uniform_real_distribution<float> margin(-1.0f, 1.0f);
  std::vector<float>                    margins(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  std::generate(margins.begin(), margins.end(), [&] { return margin(draw); });
  const Collector surface = Build(size, true, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return margins[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)];
  });
  EXPECT_GT(surface.m_Triangles.size(), 5000u);
  ExpectClosed(surface);
  EXPECT_GT(GetVolume(surface), 0.0);
}

TEST(MedialVoxelIsosurface, OfOneVoxelIsAnOctahedron)
{
  const Collector surface = Build({ 1, 1, 1 }, true, [](auto...) { return 0.5f; });
  EXPECT_EQ(surface.m_Vertices.size(), 6u);
  EXPECT_EQ(surface.m_Triangles.size(), 8u);
  ExpectClosed(surface);
  EXPECT_NEAR(GetVolume(surface), 1.0 / 6.0, 1e-12);
  EXPECT_TRUE(Build({ 1, 1, 1 }, false, [](auto...) { return 0.5f; }).m_Vertices.empty());
}

TEST(MedialVoxelIsosurface, CrossesWhereLinearMarginsDo)
{
  // Of a plane across z, whose margins are zero at 2.3.
  const Collector surface =
    Build({ 4, 4, 6 }, false, [](auto, auto, std::int64_t z) { return static_cast<float>(2.3 - z); });
  EXPECT_EQ(surface.m_Vertices.size(), 16u);
  EXPECT_EQ(surface.m_Triangles.size(), 18u);
  for (const auto & vertex : surface.m_Vertices)
  {
    EXPECT_NEAR(vertex.point[2], 2.3, 1e-6);
    EXPECT_EQ(vertex.object[2], 2);
  }
  for (const auto & triangle : surface.m_Triangles)
  {
    EXPECT_FALSE(triangle.isCap);
  }
}

TEST(MedialVoxelIsosurface, MarginsOfZeroAndNaNKeepVerticesApart)
{
  const float nan = std::nanf("");
  const auto  surface = Build({ 3, 1, 1 }, true, [nan](std::int64_t x, auto, auto) { return x == 1 ? 0.0f : nan; });
  ExpectClosed(surface);
  std::set<std::array<double, 3>> points;
  for (const auto & vertex : surface.m_Vertices)
  {
    points.insert(vertex.point);
  }
  EXPECT_EQ(points.size(), 6u);
  const auto zero = Build({ 3, 1, 1 }, false, [](std::int64_t x, auto, auto) { return x == 1 ? 0.0f : -1.0f; });
  EXPECT_TRUE(zero.m_Triangles.empty());
  EXPECT_EQ(zero.m_Vertices.size(), 2u);
  EXPECT_NEAR(zero.m_Vertices[0].point[0], 1.0 - 1.0 / 256.0, 1e-12);
}

/** Number of sets that are left when those of the pairs are put together. */
std::size_t
CountSets(std::size_t                                                                        numberOfItems,
          const std::function<void(const std::function<void(std::size_t, std::size_t)> &)> & join)
{
  std::vector<std::size_t> parents(numberOfItems);
  std::iota(parents.begin(), parents.end(), std::size_t{ 0 });
  const auto find = [&parents](std::size_t item) {
    while (parents[item] != item)
    {
      item = parents[item] = parents[parents[item]];
    }
    return item;
  };
  std::size_t sets = numberOfItems;
  join([&](std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    sets -= a == b ? 0 : 1;
    parents[a] = b;
  });
  return sets;
}

std::size_t
CountComponents(const Collector & surface)
{
  return CountSets(surface.m_Vertices.size(), [&surface](const auto & join) {
    for (const auto & triangle : surface.m_Triangles)
    {
      join(triangle.vertices[0], triangle.vertices[1]);
      join(triangle.vertices[0], triangle.vertices[2]);
    }
  });
}

/** Components of the voxels that are object or not, of neighbors that are at most so many steps along axes apart.
 * Voxels of the other kind are not counted. */
template <typename TIsObject>
std::size_t
CountVoxelComponents(const Index & size, bool ofObject, std::int64_t mostSteps, const TIsObject & isObject)
{
  // With a layer of background around the image.
  const Index full{ size[0] + 2, size[1] + 2, size[2] + 2 };
  const auto  isWanted = [&](const Index & voxel) {
    const bool isInside =
      voxel[0] > 0 && voxel[0] <= size[0] && voxel[1] > 0 && voxel[1] <= size[1] && voxel[2] > 0 && voxel[2] <= size[2];
    return (isInside && isObject(voxel[0] - 1, voxel[1] - 1, voxel[2] - 1)) == ofObject;
  };
  const auto offsetOf = [&full](const Index & voxel) {
    return static_cast<std::size_t>((voxel[2] * full[1] + voxel[1]) * full[0] + voxel[0]);
  };
  std::vector<Index> wanted;
  for (std::int64_t i = 0; i < full[0] * full[1] * full[2]; ++i)
  {
    const Index voxel{ i % full[0], i / full[0] % full[1], i / full[0] / full[1] };
    if (isWanted(voxel))
    {
      wanted.push_back(voxel);
    }
  }
  const auto numberOfAll = static_cast<std::size_t>(full[0] * full[1] * full[2]);
  const auto sets = CountSets(numberOfAll, [&](const auto & join) {
    for (const Index & voxel : wanted)
    {
      for (std::int64_t step = 14; step < 27; ++step)
      {
        const Index way{ step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1 };
        const Index other{ voxel[0] + way[0], voxel[1] + way[1], voxel[2] + way[2] };
        const bool  isInside = other[0] >= 0 && other[0] < full[0] && other[1] >= 0 && other[1] < full[1] &&
                              other[2] >= 0 && other[2] < full[2];
        if (std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]) <= mostSteps && isInside && isWanted(other))
        {
          join(offsetOf(voxel), offsetOf(other));
        }
      }
    }
  });
  return sets - (numberOfAll - wanted.size());
}

std::int64_t
GetEulerNumber(const Collector & surface)
{
  return static_cast<std::int64_t>(surface.m_Vertices.size() + surface.m_Triangles.size() -
                                   CountSides(surface).size() / 2);
}

TEST(MedialVoxelIsosurface, HasAComponentForEachObjectAndCavity)
{
  // In space without handles, each component of the surface has a component of the object on one side and one of the
  // background on the other, and these make up a tree. Object is connected along edges, background along faces.
  const Index  size{ 13, 11, 12 };
  std::mt19937 draw(3);
  for (const double share : { 0.1, 0.3, 0.5, 0.8, 0.95 })
  {
    std::bernoulli_distribution isSet(share);
    std::vector<bool>           object(static_cast<std::size_t>(size[0] * size[1] * size[2]));
    std::generate(object.begin(), object.end(), [&] { return isSet(draw); });
    const auto isObject = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      return object[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)];
    };
    const Collector surface =
      Build(size, true, [&](auto x, auto y, auto z) { return isObject(x, y, z) ? 0.5f : -0.5f; });
    ExpectClosed(surface);
    EXPECT_EQ(CountComponents(surface) + 1,
              CountVoxelComponents(size, true, 2, isObject) + CountVoxelComponents(size, false, 1, isObject))
      << share;
  }
}

TEST(MedialVoxelIsosurface, HasTheHandlesOfThePhantom)
{
  const Index size{ 20, 12, 9 };
  const auto  isIn = [](std::int64_t x, std::int64_t y, std::int64_t z, const Index & first, const Index & last) {
    return x >= first[0] && x <= last[0] && y >= first[1] && y <= last[1] && z >= first[2] && z <= last[2];
  };
  // A block up to a face of the image with two holes through it and a cavity, and another one that touches an edge of
  // it.
  const auto margin = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    const bool block = isIn(x, y, z, { 0, 1, 1 }, { 14, 9, 5 });
    const bool holes = isIn(x, y, z, { 2, 3, 0 }, { 3, 4, 8 }) || isIn(x, y, z, { 6, 3, 0 }, { 7, 4, 8 });
    const bool cavity = isIn(x, y, z, { 11, 5, 3 }, { 12, 6, 3 });
    const bool second = isIn(x, y, z, { 15, 2, 6 }, { 18, 3, 7 });
    return (block && !holes && !cavity) || second ? 0.5f : -0.5f;
  };
  const Collector surface = Build(size, true, margin);
  ExpectClosed(surface);
  EXPECT_EQ(CountComponents(surface), 2u);
  EXPECT_EQ(GetEulerNumber(surface), 2 * (1 - 2 + 1));
}

/** A part that is inside where the distance is positive: its volume, and its boundary. */
void
ExpectShape(const std::function<double(double, double, double)> & distance, double volume)
{
  const Index     size{ 48, 48, 48 };
  const Collector surface = Build(size, true, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return static_cast<float>(distance(x - 23.3, y - 23.7, z - 22.9));
  });
  ExpectClosed(surface);
  EXPECT_NEAR(GetVolume(surface) / volume, 1.0, 0.01);
  for (const auto & vertex : surface.m_Vertices)
  {
    const auto & p = vertex.point;
    EXPECT_NEAR(distance(p[0] - 23.3, p[1] - 23.7, p[2] - 22.9), 0.0, 0.05);
  }
}

TEST(MedialVoxelIsosurface, HasTheVolumeOfGrayShapes)
{
  constexpr double pi = 3.14159265358979323846;
  ExpectShape([](double x, double y, double z) { return 17.6 - std::sqrt(x * x + y * y + z * z); },
              4.0 / 3.0 * pi * 17.6 * 17.6 * 17.6);
  ExpectShape([](double x,
                 double y,
                 double z) { return 5.4 - std::hypot(std::hypot(x, 0.6 * y - 0.8 * z) - 13.2, 0.8 * y + 0.6 * z); },
              2.0 * pi * pi * 13.2 * 5.4 * 5.4);
  // A tilted plate with a round rim.
  ExpectShape(
    [](double x, double y, double z) {
      const double height = (2.0 * x + 3.0 * y + 6.0 * z) / 7.0;
      const double radius = std::sqrt(x * x + y * y + z * z - height * height);
      return 2.3 - std::hypot(height, std::max(0.0, radius - 13.0));
    },
    4.6 * pi * 169.0 + pi * pi * 13.0 * 2.3 * 2.3 + 4.0 / 3.0 * pi * 2.3 * 2.3 * 2.3);
}

} // namespace
