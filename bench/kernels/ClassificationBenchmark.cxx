// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Kernels of the classification phase; items are cells, pairs or searches.

#include "KernelScene.h"

#include "itkMedialVoxelClassifier.h"
#include "itkMedialVoxelPairChoice.h"

#include <benchmark/benchmark.h>

namespace
{
using itk::MedialVoxelBox;
using itk::MedialVoxelDisplacement;
using itk::MedialVoxelIndex;

const MedialVoxelBox middleTile{ { { 0, 80, 80 } }, { { 192, 112, 112 } } };

itk::MedialVoxelFeatures
FeaturesOf(const KernelScene & scene, const MedialVoxelBox & box)
{
  itk::MedialVoxelFeatureTransform::Workspace workspace;
  itk::MedialVoxelFeatures                    features;
  itk::MedialVoxelFeatureTransform(scene.grid).Compute(scene.GetWindow(), box, workspace, features);
  return features;
}

itk::MedialVoxelParameters
ParametersFor(std::int64_t thickness)
{
  itk::MedialVoxelParameters parameters;
  parameters.epsilon = itk::MedialVoxelParameters::EpsilonFromThickness(static_cast<double>(thickness));
  return parameters;
}

/** All phases for one tile, without the distance transform. */
void
ClassifyTile(benchmark::State & state)
{
  const auto                            name = static_cast<KernelSceneName>(state.range(0));
  const KernelScene &                   scene = GetKernelScene(name);
  const itk::MedialVoxelClassifier      classifier(scene.grid, ParametersFor(state.range(1)));
  const itk::MedialVoxelFeatures        features = FeaturesOf(scene, classifier.GetVoxelBox(middleTile));
  itk::MedialVoxelClassifier::Workspace workspace;
  std::vector<std::uint8_t>             labels;
  itk::MedialVoxelCounts                counts;
  for (auto _ : state)
  {
    classifier.Classify(
      scene.GetWindow(), middleTile, features, itk::MedialVoxelNoProgress(), workspace, labels, counts);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(counts.candidateCells));
  state.SetLabel(GetKernelSceneLabel(name));
}
BENCHMARK(ClassifyTile)
  ->ArgNames({ "scene", "thickness" })
  ->ArgsProduct({ { ThinScene, ThickScene }, { 2, 3, 5, 8 } })
  ->Unit(benchmark::kMillisecond);

struct PointPair
{
  MedialVoxelIndex a, b;
};

/** The pairs of the first diagonal in the middle of the thin scene that no bound decides. */
std::vector<PointPair>
UndecidedPairs(const KernelScene & scene, double epsilon)
{
  const itk::MedialVoxelDualCell cell(scene.grid);
  const itk::MedialVoxelFeatures features = FeaturesOf(scene, middleTile);
  std::vector<PointPair>         pairs;
  for (std::int64_t z = middleTile.lower[2]; z + 1 < middleTile.upper[2]; ++z)
  {
    for (std::int64_t y = middleTile.lower[1]; y + 1 < middleTile.upper[1]; ++y)
    {
      for (std::int64_t x = middleTile.lower[0]; x + 1 < middleTile.upper[0]; ++x)
      {
        if (!scene.object.Test({ { x, y, z } }) || !scene.object.Test({ { x + 1, y + 1, z + 1 } }))
        {
          continue;
        }
        const std::size_t             i = features.OffsetOf(x, y, z);
        const std::size_t             j = features.OffsetOf(x + 1, y + 1, z + 1);
        const MedialVoxelDisplacement first{ { features.dx[i], features.dy[i], features.dz[i] } };
        const MedialVoxelDisplacement second{ { features.dx[j], features.dy[j], features.dz[j] } };
        const MedialVoxelDisplacement difference{
          { first[0] - second[0] - 1, first[1] - second[1] - 1, first[2] - second[2] - 1 }
        };
        if (!cell.IsTrivial(difference, epsilon) && cell.FreeSpaceLength(difference) < epsilon)
        {
          const MedialVoxelIndex a{ { x + first[0], y + first[1], z + first[2] } };
          pairs.push_back({ a, { { a[0] - difference[0], a[1] - difference[1], a[2] - difference[2] } } });
        }
      }
    }
  }
  return pairs;
}

/** Bounded geodesic searches of a tile of thin walls. */
void
SearchGeodesics(benchmark::State & state)
{
  const KernelScene &                        scene = GetKernelScene(ThinScene);
  const double                               epsilon = ParametersFor(state.range(0)).epsilon;
  const std::vector<PointPair>               pairs = UndecidedPairs(scene, epsilon);
  const itk::MedialVoxelBoundedGeodesic      geodesic(scene.grid, epsilon);
  itk::MedialVoxelBoundedGeodesic::Workspace workspace;
  for (auto _ : state)
  {
    std::int64_t medial = 0;
    geodesic.Begin(scene.boundary, middleTile, workspace);
    for (const PointPair & pair : pairs)
    {
      medial += geodesic.ReachesThreshold(pair.a, pair.b, workspace) ? 1 : 0;
    }
    benchmark::DoNotOptimize(medial);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}
BENCHMARK(SearchGeodesics)->ArgName("thickness")->Arg(2)->Arg(3)->Arg(5)->Arg(8)->Unit(benchmark::kMillisecond);

/** The same pairs by bit operations; items are pairs. */
void
FloodBits(benchmark::State & state)
{
  const KernelScene &            scene = GetKernelScene(ThinScene);
  const double                   epsilon = ParametersFor(state.range(0)).epsilon;
  const std::vector<PointPair>   pairs = UndecidedPairs(scene, epsilon);
  const itk::MedialVoxelBitFlood flood(scene.grid, epsilon);
  for (auto _ : state)
  {
    std::int64_t medial = 0;
    for (const PointPair & pair : pairs)
    {
      const auto result = flood.Decide(
        scene.boundary, pair.a, { { pair.a[0] - pair.b[0], pair.a[1] - pair.b[1], pair.a[2] - pair.b[2] } });
      medial += (result == itk::MedialVoxelBitFlood::Result::Reaches) ? 1 : 0;
    }
    benchmark::DoNotOptimize(medial);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}
BENCHMARK(FloodBits)->ArgName("thickness")->Arg(2)->Arg(3)->Arg(5)->Unit(benchmark::kMillisecond);

/** Corners of the cells of the middle of a scene, by rows of 64 cells. */
template <typename TVisitor>
void
VisitCornerRows(const itk::MedialVoxelFeatures & features, TVisitor && visit)
{
  const auto nx = static_cast<std::size_t>(features.box.Extent(0));
  const auto slice = nx * static_cast<std::size_t>(features.box.Extent(1));
  for (std::int64_t z = features.box.lower[2]; z + 1 < features.box.upper[2]; ++z)
  {
    for (std::int64_t y = features.box.lower[1]; y + 1 < features.box.upper[1]; ++y)
    {
      const std::size_t          offset = features.OffsetOf(features.box.lower[0], y, z);
      itk::MedialVoxelCornerRows corners;
      const std::int32_t *       components[] = { features.dx.data(), features.dy.data(), features.dz.data() };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::int32_t * const first = components[axis] + offset;
        corners.rows[axis] = { { first, first + nx, first + slice, first + slice + nx } };
      }
      visit(corners);
    }
  }
}

/** Test of 64 cells at a time for diagonals that are not trivial; items are cells. */
void
NontrivialCells(benchmark::State & state)
{
  const itk::MedialVoxelFeatures features = FeaturesOf(GetKernelScene(ThinScene), middleTile);
  std::int64_t                   cells = 0;
  for (auto _ : state)
  {
    std::uint64_t nontrivial = 0;
    VisitCornerRows(features, [&](const itk::MedialVoxelCornerRows & corners) {
      nontrivial ^= itk::MedialVoxelNontrivialCells(corners, ~std::uint64_t{ 0 }, 64);
      cells += 64;
    });
    benchmark::DoNotOptimize(nontrivial);
  }
  state.SetItemsProcessed(cells);
}
BENCHMARK(NontrivialCells)->Unit(benchmark::kMicrosecond);

/** Choice of one of four diagonals; items are cells. */
void
WidestDiagonals(benchmark::State & state)
{
  const itk::MedialVoxelFeatures features = FeaturesOf(GetKernelScene(ThinScene), middleTile);
  std::int64_t                   cells = 0;
  for (auto _ : state)
  {
    std::array<std::int8_t, 64> widest{};
    VisitCornerRows(features, [&](const itk::MedialVoxelCornerRows & corners) {
      itk::MedialVoxelWidestDiagonals(corners, ~std::uint64_t{ 0 }, 64, widest.data());
      cells += 64;
    });
    benchmark::DoNotOptimize(widest);
  }
  state.SetItemsProcessed(cells);
}
BENCHMARK(WidestDiagonals)->Unit(benchmark::kMicrosecond);

/** Angle keys of the four diagonals of one cell. */
void
CosineKeys(benchmark::State & state)
{
  const KernelScene &            scene = GetKernelScene(ThinScene);
  const itk::MedialVoxelDualCell cell(scene.grid);
  MedialVoxelDisplacement        a{ { 2, -1, 0 } };
  const MedialVoxelDisplacement  b{ { -3, 1, 1 } };
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(a);
    for (unsigned int diagonal = 0; diagonal < cell.GetNumberOfDiagonals(); ++diagonal)
    {
      benchmark::DoNotOptimize(cell.CosineKey(diagonal, a, b));
    }
  }
  state.SetItemsProcessed(state.iterations() * cell.GetNumberOfDiagonals());
}
BENCHMARK(CosineKeys);
} // namespace
