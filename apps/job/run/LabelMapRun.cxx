// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LabelMapRun.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** Objects that are planned for when all are wanted. */
constexpr std::size_t PlannedObjects = 64;

} // namespace

LabelMapRun::LabelMapRun(itk::MedialVoxelObjectMap & map,
                         const VolumeGeometry &      geometry,
                         std::uint64_t               maximumPoreSize,
                         const Survey &              survey)
  : m_Map(map)
  , m_Geometry(geometry)
  , m_Union(map, geometry.GetVoxelBox().upper, maximumPoreSize)
  , m_Survey(survey, m_Union.GetRegion())
{}

std::uint64_t
LabelMapRun::GetPlannedMemory(const LabelSelection & selection)
{
  return ObjectSurvey::MemoryPerObject *
         (selection.all ? PlannedObjects : selection.values.size() + selection.names.size());
}

std::uint64_t
LabelMapRun::GetUnplannedMemory(const LabelSelection & selection, std::size_t numberOfObjects)
{
  const std::uint64_t bytes = ObjectSurvey::MemoryPerObject * numberOfObjects;
  return bytes - std::min(bytes, GetPlannedMemory(selection));
}

void
LabelMapRun::AddVolume(const VolumeRequest & request, VoxelOutput & volume)
{
  m_Volumes.push_back({ request, &volume, {} });
}

void
LabelMapRun::AddMesh(SheetMesh & mesh)
{
  m_Mesh = &mesh;
  mesh.FindObjectsWith(
    [this](const itk::MedialVoxelIndex & cell) { return m_Union.GetRegion().FindOwner(cell, m_Map.GetShownPass()); });
}

itk::MedialVoxelSums
LabelMapRun::Run(PieceLoop & loop, PieceEngine & engine, const SliceRange & piece, WriteBehind & writer)
{
  const itk::MedialVoxelBox region = engine.GetRegion({ piece });
  m_Union.Begin(region, this->MakeValues(region, engine));
  engine.SendTilesTo([this](const itk::MedialVoxelTileResult & tile) {
    m_Union.TakeTile(tile);
    m_Cells ? m_Cells->TakeTile(tile) : void();
  });
  if (m_Mesh)
  {
    m_Mesh->SetObjectLabels(m_Map.GetTable().GetValues());
  }
  itk::MedialVoxelSums sums;
  for (unsigned int pass = 0; pass < m_Map.GetNumberOfPasses(); ++pass)
  {
    m_Map.ShowPass(pass);
    m_Survey.SetPass(pass);
    if (m_Mesh)
    {
      m_Mesh->BeginPass(pass);
    }
    m_Cells ? m_Cells->BeginPass(region, pass) : void();
    sums += loop.Run(engine, piece, {}, writer);
    m_Union.FinishPass();
    m_Cells ? m_Cells->FinishPass() : void();
    // The window shows the objects of this pass.
    engine.DropWindow();
  }
  m_Cells ? m_Cells->WriteUnion(region, m_Union) : void();
  m_Union.Finish();
  m_SharedCells += m_Union.GetSums().shared;
  for (const Volume & volume : m_Volumes)
  {
    this->Write(volume, piece.begin * m_Geometry.GetVoxelsPerSlice());
  }
  return sums;
}

std::vector<itk::MedialVoxelObjectUnion::Values>
LabelMapRun::MakeValues(const itk::MedialVoxelBox & region, const PieceEngine & engine)
{
  std::vector<itk::MedialVoxelObjectUnion::Values> values;
  for (Volume & volume : m_Volumes)
  {
    const VolumeRequest & request = volume.request;
    if (this->IsOfLabels(volume) || request.filler == VolumeFiller::Objects)
    {
      continue;
    }
    const std::size_t bytes = request.layout.GetBytes();
    volume.voxels.assign(static_cast<std::size_t>(region.NumberOfVoxels()) * bytes, std::byte{ 0 });
    const auto write = [&](const auto & tile, void * first, const auto & strides) {
      engine.WriteTile(tile, request, first, strides);
    };
    values.push_back({ volume.voxels.data(), bytes, write });
  }
  return values;
}

void
LabelMapRun::Write(const Volume & volume, std::uint64_t firstVoxel) const
{
  if (volume.request.filler == VolumeFiller::Objects)
  {
    WriteObjectValues(m_Union.GetObjects(),
                      m_Map.GetTable(),
                      volume.request.layout.pixelType,
                      m_Geometry.GetVoxelsPerSlice(),
                      firstVoxel,
                      *volume.output);
    return;
  }
  const void * const voxels = this->IsOfLabels(volume) ? static_cast<const void *>(m_Union.GetLabels().data())
                                                       : static_cast<const void *>(volume.voxels.data());
  volume.output->Write(firstVoxel, m_Union.GetLabels().size(), voxels);
}

Json
LabelMapRun::Summarize() const
{
  return { { "passes", m_Map.GetNumberOfPasses() },
           { "shared_cells", m_SharedCells },
           { "objects", m_Survey.Summarize(m_Map) } };
}

} // end namespace medialvoxel
