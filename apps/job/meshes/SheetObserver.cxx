// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetObserver.h"

#include "MeshPlacement.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** Bytes of cells that wait for their piece, for each of its voxels: one cell for each 8 is more
 * than most parts have. */
constexpr std::uint64_t MostPending = 8;

/** Planned number of cells in the slices being smoothed: cells of thin walls, of which some lie along the slices. */
constexpr std::uint64_t VoxelsPerCellInWork = 3;
constexpr std::uint64_t CellInWorkSize = 152;

/** A cell that waits for its piece to be done, in a vector that grows by a quarter. */
constexpr std::uint64_t PendingCellSize = sizeof(itk::MedialVoxelSurfaceCell) * 5 / 4;
static_assert(PendingCellSize <= 8 * MostPending);

/** Cells that may wait at least; pieces that find more than fit are done in smaller ones. */
std::uint64_t
GetPendingCells(const VolumeGeometry & geometry)
{
  constexpr std::uint64_t least = std::uint64_t{ 1 } << 16;
  return std::max(least, geometry.GetVoxelsPerSlice() / 8);
}

/** Vertices that are joined and smoothed together: some slices of a sheet, as memory allows. */
std::size_t
GetVerticesOfBatch(const VolumeGeometry & geometry)
{
  constexpr std::uint64_t most = std::uint64_t{ 1 } << 17;
  return std::min(most, geometry.GetNumberOfVoxels() / 512);
}

} // namespace

std::unique_ptr<itk::MedialVoxelSurfaceObserver>
MakeSheetObserver(const ExtractOptions &                           options,
                  const VolumeGeometry &                           geometry,
                  const itk::MedialVoxelGrid &                     grid,
                  const std::uint64_t                              surplus,
                  const itk::MedialVoxelSurfaceBuilder::RunTasks & run,
                  itk::MedialVoxelSurfaceConsumer &                consumer)
{
  const itk::MedialVoxelGrid::SpacingType spacing{ { geometry.spacing[0], geometry.spacing[1], geometry.spacing[2] } };
  auto                                    observer = std::make_unique<itk::MedialVoxelSurfaceObserver>(
    grid, GetParameters(options, grid), spacing, GetPlacement(geometry), consumer);
  observer->SetMaximumNumberOfCells(GetPendingCells(geometry) + surplus / PendingCellSize);
  if (run)
  {
    observer->RunTasksWith(run, GetVerticesOfBatch(geometry));
  }
  return observer;
}

ProductFootprint
GetSheetFootprint(const ExtractOptions & options, const VolumeGeometry & geometry, const itk::MedialVoxelGrid & grid)
{
  ProductFootprint footprint;
  footprint.beside = geometry.GetVoxelsPerSlice() / VoxelsPerCellInWork * CellInWorkSize +
                     GetPendingCells(geometry) * PendingCellSize +
                     GetVerticesOfBatch(geometry) * itk::MedialVoxelSurfaceBuilder::BytesOfVertex;
  footprint.perVoxelOfTile = itk::MedialVoxelSurfaceObserver::GetBytesPerVoxel(grid, GetParameters(options, grid));
  footprint.surplus.most = MostPending;
  footprint.surplus.planned = 1; // a cell for each 64 voxels
  return footprint;
}

} // end namespace medialvoxel
