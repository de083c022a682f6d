// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Thinning of cells: the rule against the definition of homotopy, the order against loops over the whole volume, and
// the Betti numbers of the result against the voxels.

#include "itkMedialVoxelCellLink.h"
#include "itkMedialVoxelClosedPores.h"
#include "itkMedialVoxelThinning.h"

#include "MedialVoxelTestTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
using namespace MedialVoxelTest;

using Thinning = itk::MedialVoxelThinning;

using Generator = std::mt19937;

bool
Chance(Generator & generator, const unsigned int percent)
{
  return generator() % 100 < percent;
}

/** Salt and pepper, boxes added and cut out, or a tilted noisy plate. */
Values
MakeObject(Generator & generator, const itk::MedialVoxelIndex & size)
{
  Values             object(size);
  const unsigned int kind = generator() % 3;
  const unsigned int percent = 5 + generator() % 91;
  if (kind == 0)
  {
    ForEachIndex(object.GetBox(), [&](const auto & v) { object.Set(v, Chance(generator, percent) ? 1 : 0); });
  }
  for (unsigned int i = 0; kind == 1 && i < 12; ++i)
  {
    itk::MedialVoxelBox box;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = static_cast<std::int64_t>(generator() % static_cast<unsigned int>(size[axis]));
      box.upper[axis] = std::min<std::int64_t>(size[axis], box.lower[axis] + 1 + generator() % 6);
    }
    ForEachIndex(box, [&](const auto & v) { object.Set(v, i % 3 == 2 ? 0 : 1); });
  }
  if (kind == 2)
  {
    const int a = static_cast<int>(generator() % 9) - 4;
    const int b = static_cast<int>(generator() % 9) - 4;
    const int width = 8 + static_cast<int>(generator() % 40);
    ForEachIndex(object.GetBox(), [&](const auto & v) {
      const auto height = a * (v[0] - size[0] / 2) + b * (v[1] - size[1] / 2) + 8 * (v[2] - size[2] / 2);
      object.Set(v, (std::abs(height) <= width) != Chance(generator, percent / 8) ? 1 : 0);
    });
  }
  return object;
}

Scene
MakeScene(const unsigned int seed, const itk::MedialVoxelIndex & size)
{
  Generator generator(seed);
  Scene     scene(size);
  scene.object = MakeObject(generator, size);
  const unsigned int medial = generator() % 4 == 0 ? 0 : generator() % 61;
  const unsigned int levels = 1 + generator() % 12;
  const auto         cells = GridOf(size).GetCellBox();
  ForEachIndex(cells, [&](const auto & cell) {
    bool isCell = false;
    ForEachIndex(itk::MedialVoxelBox{ cell, { { cell[0] + 2, cell[1] + 2, cell[2] + 2 } } },
                 [&](const auto & corner) { isCell = isCell || scene.object.Get(corner) != 0; });
    scene.medial.Set(cell, isCell && Chance(generator, medial) ? 1 : 0);
    scene.levels.Set(cell, static_cast<int>(generator() % levels));
  });
  return scene;
}

itk::MedialVoxelBits
SliceOf(const Values & values, const std::int64_t z)
{
  itk::MedialVoxelBox box = values.GetBox();
  box.lower[2] = z;
  box.upper[2] = z + 1;
  itk::MedialVoxelBits bits(box);
  ForEachIndex(box, [&](const auto & index) {
    if (values.Get(index) != 0)
    {
      bits.Set(index);
    }
  });
  return bits;
}

struct Thinned
{
  Values      kept;
  std::size_t mostHeld{ 0 };
  int         numberAdded{ 0 };
};

Thinned
Thin(const Scene & scene)
{
  const auto & size = scene.object.GetBox().upper;
  Thinned      result{ Values(size) };
  std::int64_t slices = 0;
  Thinning     thinning(GridOf(size), [&](const std::int64_t z, const auto & kept, const auto & added) {
    EXPECT_EQ(z, slices++);
    itk::MedialVoxelBox box = scene.object.GetBox();
    box.lower[2] = z;
    box.upper[2] = z + 1;
    ForEachIndex(box, [&](const auto & cell) {
      result.kept.Set(cell, kept.Test(cell) ? 1 : 0);
      result.numberAdded += added.Test(cell) ? 1 : 0;
      EXPECT_EQ(added.Test(cell), kept.Test(cell) && scene.medial.Get(cell) == 0);
    });
  });
  for (std::int64_t z = 0; z < size[2]; ++z)
  {
    std::vector<Thinning::LevelType> levels;
    for (std::int64_t y = 0; y < size[1]; ++y)
    {
      for (std::int64_t x = 0; x < size[0]; ++x)
      {
        levels.push_back(static_cast<Thinning::LevelType>(scene.levels.Get(x, y, z)));
      }
    }
    thinning.AddSlice(SliceOf(scene.object, z), SliceOf(scene.medial, z), levels);
    result.mostHeld = std::max(result.mostHeld, thinning.GetNumberOfHeldSlices());
  }
  EXPECT_EQ(slices, GridOf(size).GetCellBox().Extent(2));
  return result;
}

/** Whether the link is contractible: in the octahedron's sphere, it and the rest are one part each. */
bool
HasContractibleLink(const Values & object, const Values & cells, const itk::MedialVoxelIndex & cell)
{
  const CellComplex     complex(object, cells);
  itk::MedialVoxelIndex size{ { 3, 3, 3 } };
  const auto isFace = [](const itk::MedialVoxelIndex & step) { return step != itk::MedialVoxelIndex{ { 1, 1, 1 } }; };
  const auto isLink = [&](const itk::MedialVoxelIndex & step) {
    return isFace(step) &&
           complex.Has({ { 2 * cell[0] + 1 + step[0], 2 * cell[1] + 1 + step[1], 2 * cell[2] + 1 + step[2] } });
  };
  const auto isRest = [&](const itk::MedialVoxelIndex & step) { return isFace(step) && !isLink(step); };
  return CountFaceComponents(size, isLink, false) == 1 && CountFaceComponents(size, isRest, false) == 1;
}

std::vector<itk::MedialVoxelIndex>
GetSizes()
{
  return { { { 9, 8, 10 } },  { { 12, 11, 9 } }, { { 7, 7, 14 } }, { { 14, 13, 1 } }, { { 13, 1, 14 } },
           { { 1, 12, 15 } }, { { 70, 4, 5 } },  { { 20, 1, 1 } }, { { 2, 2, 2 } } };
}

TEST(MedialVoxelThinning, ACellIsSimpleWhenItsLinkIsContractible)
{
  Generator                   generator(1);
  const itk::MedialVoxelIndex size{ { 4, 4, 4 } };
  const itk::MedialVoxelIndex cell{ { 1, 1, 1 } };
  int                         simple = 0;
  for (int i = 0; i < 20000; ++i)
  {
    Values             object(size);
    Values             cells(size);
    const unsigned int voxels = 10 + generator() % 91;
    const unsigned int others = 20 + generator() % 81;
    ForEachIndex(object.GetBox(), [&](const auto & v) { object.Set(v, Chance(generator, voxels) ? 1 : 0); });
    ForEachIndex(itk::MedialVoxelBox{ { { 0, 0, 0 } }, { { 3, 3, 3 } } },
                 [&](const auto & other) { cells.Set(other, other == cell || Chance(generator, others) ? 1 : 0); });
    const bool isSimple = itk::MedialVoxelCellLink::IsSimple(CellsAround(cells, cell), VoxelsAround(object, cell));
    ASSERT_EQ(isSimple, HasContractibleLink(object, cells, cell)) << i;
    simple += isSimple ? 1 : 0;
  }
  EXPECT_GT(simple, 2000);
  EXPECT_LT(simple, 18000);
}

TEST(MedialVoxelThinning, SlicesGiveTheResultOfTheWholeVolume)
{
  for (const auto & size : GetSizes())
  {
    for (unsigned int seed = 0; seed < 30; ++seed)
    {
      const Scene scene = MakeScene(seed, size);
      ASSERT_TRUE(Thin(scene).kept == ThinInLoops(scene)) << size[0] << ' ' << size[1] << ' ' << size[2] << ' ' << seed;
    }
  }
}

TEST(MedialVoxelThinning, TheResultHasTheBettiNumbersOfTheVoxels)
{
  int deleted = 0;
  for (const auto & size : GetSizes())
  {
    for (unsigned int seed = 100; seed < 130; ++seed)
    {
      const Scene scene = MakeScene(seed, size);
      const auto  result = Thin(scene);
      ASSERT_EQ(FindBettiNumbers(scene.object, result.kept), FindBettiNumbersOfVoxels(scene.object))
        << size[0] << ' ' << size[1] << ' ' << size[2] << ' ' << seed;
      ForEachIndex(GridOf(size).GetCellBox(), [&](const auto & cell) {
        EXPECT_TRUE(scene.medial.Get(cell) == 0 || result.kept.Get(cell) != 0);
        deleted += VoxelsAround(scene.object, cell) != 0 && result.kept.Get(cell) == 0 ? 1 : 0;
      });
    }
  }
  EXPECT_GT(deleted, 30000);
}

/** Without medial cells, a thick plate becomes a cell, a plate with a hole a ring. */
TEST(MedialVoxelThinning, ThePartsKeepOneCellOrOneLine)
{
  for (const bool hasHole : { false, true })
  {
    Scene scene(itk::MedialVoxelIndex{ { 20, 20, 12 } });
    ForEachIndex(itk::MedialVoxelBox{ { { 3, 3, 4 } }, { { 17, 17, 8 } } }, [&](const auto & v) {
      const bool isHole = v[0] >= 8 && v[0] < 12 && v[1] >= 8 && v[1] < 12;
      scene.object.Set(v, hasHole && isHole ? 0 : 1);
    });
    ForEachIndex(scene.object.GetBox(), [&](const auto & cell) {
      const auto depth = [&](const unsigned int axis, const std::int64_t lower, const std::int64_t upper) {
        return std::min(cell[axis] + 1 - lower, upper - 1 - cell[axis]);
      };
      scene.levels.Set(
        cell,
        static_cast<int>(std::max<std::int64_t>(0, std::min({ depth(0, 3, 17), depth(1, 3, 17), depth(2, 4, 8) }))));
    });
    const auto result = Thin(scene);
    EXPECT_EQ(FindBettiNumbers(scene.object, result.kept), FindBettiNumbersOfVoxels(scene.object));
    EXPECT_LE(result.numberAdded, 120) << hasHole;
    EXPECT_GE(result.numberAdded, hasHole ? 16 : 1);
  }
}

TEST(MedialVoxelThinning, AnObjectWithoutBoundaryStaysAndAddsNothing)
{
  Scene scene(itk::MedialVoxelIndex{ { 5, 6, 7 } });
  ForEachIndex(scene.object.GetBox(), [&](const auto & v) {
    scene.object.Set(v, 1);
    scene.levels.Set(v, Thinning::NoLevel);
  });
  const auto & size = scene.object.GetBox().upper;
  int          kept = 0;
  Thinning     thinning(GridOf(size), [&](std::int64_t, const auto & cells, const auto & added) {
    kept += static_cast<int>(cells.Count(cells.GetBox()));
    EXPECT_EQ(added.Count(added.GetBox()), 0u);
  });
  for (std::int64_t z = 0; z < size[2]; ++z)
  {
    thinning.AddSlice(
      SliceOf(scene.object, z), SliceOf(scene.medial, z), std::vector<Thinning::LevelType>(30, Thinning::NoLevel));
  }
  EXPECT_EQ(kept, 4 * 5 * 6);
}

/** Beyond 8/3 (level + 8) + 10/3 voxels along an axis, other voxels, medial cells and levels change nothing. */
TEST(MedialVoxelThinning, CellsDependOnNothingBeyondTheBound)
{
  constexpr std::int64_t length = 90;
  constexpr std::int64_t known = 30;
  int                    differences = 0;
  for (unsigned int seed = 0; seed < 90; ++seed)
  {
    const unsigned int    axis = seed % 3;
    const int             level = static_cast<int>(seed % 5);
    const std::int64_t    bound = (8 * (level + Thinning::NumberOfChances) + 10) / 3;
    itk::MedialVoxelIndex size{ { 7, 7, 7 } };
    size[axis] = length;
    Scene      scene = MakeScene(seed, size);
    Scene      other = MakeScene(1000 + seed, size);
    const auto limit = [&](Scene & changed) {
      ForEachIndex(changed.levels.GetBox(),
                   [&](const auto & cell) { changed.levels.Set(cell, std::min(changed.levels.Get(cell), level)); });
    };
    limit(scene);
    limit(other);
    // Cells of the last known slice have corners in the next one.
    ForEachIndex(scene.object.GetBox(), [&](const auto & v) {
      if (v[axis] <= known + bound)
      {
        other.object.Set(v, scene.object.Get(v));
      }
      if (v[axis] < known + bound)
      {
        other.medial.Set(v, scene.medial.Get(v));
        other.levels.Set(v, scene.levels.Get(v));
      }
    });
    const Values kept = Thin(scene).kept;
    const Values keptOfOther = Thin(other).kept;
    ForEachIndex(kept.GetBox(), [&](const auto & cell) {
      const bool isSame = kept.Get(cell) == keptOfOther.Get(cell);
      EXPECT_TRUE(isSame || cell[axis] > known) << seed;
      differences += isSame ? 0 : 1;
    });
  }
  EXPECT_GT(differences, 1000);
}

/** One slice for each change of the parity of z in the passes of the levels, and the slices at both ends. */
TEST(MedialVoxelThinning, SlicesAreHeldAsFarAsTheBoundSays)
{
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    Scene     scene = MakeScene(seed, itk::MedialVoxelIndex{ { 6, 6, 120 } });
    const int level = static_cast<int>(seed % 8);
    ForEachIndex(scene.levels.GetBox(), [&](const auto & cell) { scene.levels.Set(cell, level); });
    EXPECT_LE(Thin(scene).mostHeld, Thinning::GetMostHeldSlices(static_cast<std::uint64_t>(level))) << seed;
  }
}

TEST(MedialVoxelThinning, ClosedPoresAreFilledUpToTheirSize)
{
  int filled = 0;
  for (const auto & size : GetSizes())
  {
    for (unsigned int seed = 0; seed < 60; ++seed)
    {
      Generator         generator(seed);
      Values            object = MakeObject(generator, size);
      const std::size_t maximumSize = seed % 3 == 0 ? 1 : generator() % 40;
      const Values      expected = FillInLoops(object, maximumSize);
      Values            result(size);

      itk::MedialVoxelClosedPores pores(GridOf(size), maximumSize);
      std::int64_t                taken = 0;
      for (std::int64_t z = 0; z < size[2]; ++z)
      {
        pores.AddSlice(SliceOf(object, z));
        for (; pores.HasSlice(); ++taken)
        {
          const auto slice = pores.TakeSlice();
          ForEachIndex(slice.GetBox(), [&](const auto & v) {
            EXPECT_EQ(v[2], taken);
            result.Set(v, slice.Test(v) ? 1 : 0);
            filled += slice.Test(v) && object.Get(v) == 0 ? 1 : 0;
          });
        }
      }
      EXPECT_EQ(taken, size[2]);
      ASSERT_TRUE(result == expected) << size[0] << ' ' << size[1] << ' ' << size[2] << ' ' << seed;
    }
  }
  EXPECT_GT(filled, 1000);
}

} // namespace
