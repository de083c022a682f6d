// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Kernels of the distance phase; items are voxels.

#include "KernelScene.h"

#include "itkMedialVoxelBoundary.h"
#include "itkMedialVoxelRowPass.h"

#include <benchmark/benchmark.h>

namespace
{
using itk::MedialVoxelBits;
using itk::MedialVoxelBox;

void
SetScene(benchmark::State & state)
{
  state.SetLabel(GetKernelSceneLabel(static_cast<KernelSceneName>(state.range(0))));
}

const KernelScene &
SceneOf(const benchmark::State & state)
{
  return GetKernelScene(static_cast<KernelSceneName>(state.range(0)));
}

void
ComputeBoundary(benchmark::State & state)
{
  const KernelScene & scene = SceneOf(state);
  MedialVoxelBits     boundary(scene.grid.GetVoxelBox());
  for (auto _ : state)
  {
    // The same bits are set again, which costs as much as the first time.
    itk::MedialVoxelComputeBoundary(
      scene.object, scene.grid.GetVoxelBox(), itk::MedialVoxelBoundary::Background, scene.grid.GetVoxelBox(), boundary);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * scene.grid.GetVoxelBox().NumberOfVoxels());
  SetScene(state);
}
BENCHMARK(ComputeBoundary)->Arg(ThinScene)->Arg(ThickScene)->Unit(benchmark::kMicrosecond);

/** Object voxels of the whole scene by the sorted displacements of a ball. */
void
SearchOffsets(benchmark::State & state)
{
  const KernelScene &      scene = SceneOf(state);
  const auto               offsets = itk::MedialVoxelOffsetTable(itk::MedialVoxelSortedOffsets(scene.grid, 6.0));
  const MedialVoxelBox     box = scene.grid.GetVoxelBox();
  itk::MedialVoxelFeatures row;
  row.Reset({ { { 0, 0, 0 } }, { { box.upper[0], 1, 1 } } });
  for (auto _ : state)
  {
    MedialVoxelBits::WordType remaining = 0;
    for (std::int64_t z = 0; z < box.upper[2]; ++z)
    {
      for (std::int64_t y = 0; y < box.upper[1]; ++y)
      {
        for (std::int64_t x = 0; x < box.upper[0]; x += MedialVoxelBits::BitsPerWord)
        {
          const MedialVoxelBits::WordType query = scene.object.Extract(x, y, z);
          if (query != 0)
          {
            remaining |= itk::MedialVoxelSearchOffsets(
                           offsets, scene.boundary, x, y, z, query, { row.dx.data(), row.dy.data(), row.dz.data(), x })
                           .remaining;
          }
        }
      }
    }
    benchmark::DoNotOptimize(remaining);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.object.Count(box)));
  SetScene(state);
}
BENCHMARK(SearchOffsets)->Arg(ThinScene)->Arg(ThickScene)->Unit(benchmark::kMillisecond);

void
NearestInRow(benchmark::State & state)
{
  const KernelScene &       scene = SceneOf(state);
  const MedialVoxelBox      box = scene.grid.GetVoxelBox();
  std::vector<std::int32_t> displacement(static_cast<std::size_t>(box.upper[0]));
  for (auto _ : state)
  {
    for (std::int64_t z = 0; z < box.upper[2]; ++z)
    {
      for (std::int64_t y = 0; y < box.upper[1]; ++y)
      {
        itk::MedialVoxelNearestInRow(scene.boundary, 0, box.upper[0], y, z, box.upper[0], displacement.data());
        benchmark::ClobberMemory();
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * box.NumberOfVoxels());
  SetScene(state);
}
BENCHMARK(NearestInRow)->Arg(ThinScene)->Arg(ThickScene)->Unit(benchmark::kMillisecond);

/** One separable pass over 64 lanes and 192 candidate lines whose best candidate is the given number of lines away. */
void
SearchOutward(benchmark::State & state)
{
  constexpr std::int64_t lanes = 64, numberOfLines = 192;
  const std::int64_t     away = state.range(0);
  std::vector<double>    lines(lanes * numberOfLines, itk::MedialVoxelNoCost);
  std::vector<double>    squares(numberOfLines);
  for (std::int64_t j = 0; j < numberOfLines; ++j)
  {
    squares[static_cast<std::size_t>(j)] = static_cast<double>(j * j);
  }
  for (std::int64_t lane = 0; lane < lanes; ++lane)
  {
    lines[static_cast<std::size_t>((numberOfLines / 2 + away) * lanes + lane)] = static_cast<double>(lane % 4);
  }
  std::vector<double>       cost(lanes);
  std::vector<std::int64_t> position(lanes);
  for (auto _ : state)
  {
    itk::MedialVoxelSearchOutward(
      lines.data(), lanes, numberOfLines, lanes, numberOfLines / 2, squares, cost.data(), position.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * lanes);
}
BENCHMARK(SearchOutward)->Arg(4)->Arg(16)->Arg(64);

/** One pass along a row of 512 voxels whose sites are the given number of voxels apart; items are voxels. */
void
SearchRow(benchmark::State & state)
{
  using itk::MedialVoxelSiteKey;
  constexpr std::int64_t    length = 512;
  std::vector<double>       keys(length, MedialVoxelSiteKey::NoSite), result(length);
  std::vector<std::uint8_t> needed(length / itk::MedialVoxelRowPass::BlockSize, 1);
  for (std::int64_t j = 0; j < length; j += state.range(0))
  {
    keys[static_cast<std::size_t>(j)] = MedialVoxelSiteKey::AlongZ(static_cast<double>(j % 5));
  }
  itk::MedialVoxelRowPass pass(itk::MedialVoxelRowPass::Axis::Y);
  pass.SetLongestRow(length);
  for (auto _ : state)
  {
    pass.Search(keys.data(), length, 0, static_cast<std::int64_t>(needed.size()), needed.data(), result.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * length);
}
BENCHMARK(SearchRow)->Arg(4)->Arg(64)->Arg(300);

/** Complete nearest-site displacements of the middle tile. */
void
TransformTile(benchmark::State & state)
{
  const KernelScene &                         scene = SceneOf(state);
  const MedialVoxelBox                        tile{ { { 0, 80, 80 } }, { { 192, 112, 112 } } };
  const itk::MedialVoxelFeatureTransform      transform(scene.grid);
  itk::MedialVoxelFeatureTransform::Workspace workspace;
  itk::MedialVoxelFeatures                    features;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(transform.Compute(scene.GetWindow(), tile, workspace, features));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.object.Count(tile)));
  SetScene(state);
}
BENCHMARK(TransformTile)->Arg(ThinScene)->Arg(ThickScene)->Unit(benchmark::kMillisecond);
} // namespace
