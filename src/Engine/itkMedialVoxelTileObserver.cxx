// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTileObserver.h"

namespace itk
{

MedialVoxelTileObserver::Workspace::~Workspace() = default;

MedialVoxelTileObserver::~MedialVoxelTileObserver() = default;

auto
MedialVoxelTileObserver::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return nullptr;
}

void
MedialVoxelTileObserver::MeasureOnGrayValues(const MedialVoxelSheetExtraction::GrayRange &)
{}

bool
MedialVoxelTileObserver::LooksAround() const
{
  return false;
}

MedialVoxelBits::WordType
MedialVoxelTileObserver::SelectCells(const MedialVoxelCellRow &) const
{
  return 0;
}

MedialVoxelBox
MedialVoxelTileObserver::Examine(const MedialVoxelClassifiedTile &, Workspace *) const
{
  return {};
}

} // end namespace itk
