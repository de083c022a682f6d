// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Kernels of the classification phase; items are cells, pairs or searches.

#include "KernelScene.h"

#include "itkMedialVoxelClassifier.h"

#include <benchmark/benchmark.h>

namespace
{
using itk::MedialVoxelBox;
using itk::MedialVoxelDisplacement;
using itk::MedialVoxelIndex;

const MedialVoxelBox middleTile{ { { 0, 80, 80 } }, { { 192, 112, 112 } } };

class NeverAborted : public itk::MedialVoxelProgress
{
public:
  bool
  IsAborted() const override
  {
    return false;
  }

  void
  Advance(std::uint64_t) override
  {}
};

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
    classifier.Classify(scene.GetWindow(), middleTile, features, NeverAborted(), workspace, labels, counts);
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
        const MedialVoxelDisplacement difference = cell.BoundaryDifference(0, first, second);
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
    for (const PointPair & pair : pairs)
    {
      medial += geodesic.ReachesThreshold(scene.boundary, pair.a, pair.b, workspace) ? 1 : 0;
    }
    benchmark::DoNotOptimize(medial);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}
BENCHMARK(SearchGeodesics)->ArgName("thickness")->Arg(2)->Arg(3)->Arg(5)->Arg(8)->Unit(benchmark::kMillisecond);

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
