// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The memory that a filter keeps to, with an observer that takes much of it.

#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialSurfaceMeshFilter.h"
#include "itkMedialVoxelSurfaceObserver.h"

#include <algorithm>
#ifdef __GLIBC__
#  if __GLIBC_PREREQ(2, 33)
#    include <malloc.h>
#    define MEDIALVOXEL_TEST_HEAP
#  endif
#endif

namespace
{
using namespace MedialVoxelTest;

/** Bytes that are allocated and not freed. */
std::uint64_t
BytesOfHeap()
{
#ifdef MEDIALVOXEL_TEST_HEAP
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::uint64_t>(info.uordblks) + static_cast<std::uint64_t>(info.hblkhd);
#else
  return 0;
#endif
}

/** Leaves the surface out. */
class NoSurface : public itk::MedialVoxelSurfaceConsumer
{
public:
  void
  AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> &) override
  {}
  void
  AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> &) override
  {}
};

/** Has the surface searched, and remembers the most memory that was in use after a tile, but for what was found. */
class MeasuredSurface : public itk::MedialVoxelSurfaceObserver
{
public:
  using MedialVoxelSurfaceObserver::MedialVoxelSurfaceObserver;

  void
  Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) override
  {
    m_Most = std::max(m_Most, BytesOfHeap());
    m_LargestTile = std::max(m_LargestTile, tile.box.NumberOfVoxels());
    static_cast<void>(workspace);
  }

  std::uint64_t m_Most{ 0 };
  std::int64_t  m_LargestTile{ 0 };
};

/** Walls of two voxels, close to each other, in which the surface has as many vertices as there can be in walls. */
Volume
Sheets()
{
  return MakeVolume({ { 200, 150, 120 } }, UnitSpacing, [](const Index3 & v) { return v[2] % 4 < 2; });
}

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;
} // namespace

TEST(MedialVoxelWorkingMemory, ALimitHoldsForTheSurfaceToo)
{
  const Volume volume = Sheets();
  const auto   automatic =
    itk::MedialVoxelParameters::ForWalls(3.0, 16.0, itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
  // A fixed thickness whose cells are decided together.
  itk::MedialVoxelParameters fixed;
  fixed.epsilon = itk::MedialVoxelParameters::EpsilonFromThickness(6.0);
  fixed.bound = itk::MedialVoxelPseudoGeodesicBound::FreeSpace;
  for (const auto & [parameters, limit] : { std::make_pair(automatic, 100 * MiB),
                                            std::make_pair(automatic, 225 * MiB),
                                            std::make_pair(fixed, 30 * MiB),
                                            std::make_pair(fixed, 60 * MiB) })
  {
    NoSurface       nobody;
    MeasuredSurface surface(GridOf(volume), parameters, UnitSpacing, {}, nobody);
    auto            filter = MakeMedialFilter<3>(volume, 6.0);
    filter->SetThicknessMode(parameters.mode);
    filter->SetNumberOfWorkUnits(1);
    filter->SetWorkingMemoryLimit(limit);
    itk::MedialVoxelFilterAccess::SetTileObservers(*filter, { &surface });
    filter->UpdateOutputInformation();
    const std::uint64_t labels = volume.object.size();
    const std::uint64_t before = BytesOfHeap();
    filter->Update();
    EXPECT_GT(surface.m_LargestTile, 0);
    EXPECT_LE(surface.m_Most, before + labels + limit) << surface.m_LargestTile;
  }
}

TEST(MedialVoxelWorkingMemory, EdgesThatAreDecidedTogetherAreCounted)
{
  const itk::MedialVoxelGrid grid({ { 50, 50, 50 } }, { { 1.0, 1.0, 1.0 } });
  const auto                 bytesFor = [&grid](const double thickness) {
    itk::MedialVoxelParameters parameters;
    parameters.epsilon = itk::MedialVoxelParameters::EpsilonFromThickness(thickness);
    return itk::MedialVoxelSurfaceObserver::GetBytesPerVoxel(grid, parameters);
  };
  EXPECT_GE(bytesFor(6.0), bytesFor(3.0) + sizeof(itk::MedialVoxelSeparationQuery) / 8);
}

TEST(MedialVoxelWorkingMemory, TheSurfaceNeedsALimitThatHoldsItsWorkspace)
{
  const Volume volume = Sheets();
  auto         labels = MakeMedialFilter<3>(volume, 3.0);
  auto         surface = itk::MedialSurfaceMeshFilter<MaskImage<3>>::New();
  surface->SetInput(labels->GetInput());
  for (auto * const filter : { static_cast<itk::ProcessObject *>(labels), static_cast<itk::ProcessObject *>(surface) })
  {
    filter->SetNumberOfWorkUnits(1);
  }
  labels->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  surface->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  labels->SetWorkingMemoryLimit(25 * MiB);
  surface->SetWorkingMemoryLimit(25 * MiB);
  EXPECT_NO_THROW(labels->Update());
  EXPECT_THROW(surface->Update(), itk::MedialVoxelMemoryError);
  // Hosts of ITK catch nothing else.
  EXPECT_THROW(surface->Update(), itk::ExceptionObject);
  surface->SetWorkingMemoryLimit(0);
  EXPECT_NO_THROW(surface->Update());
}
