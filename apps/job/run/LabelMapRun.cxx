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

LabelMapRun::LabelMapRun(LabelMap &             map,
                         const VolumeGeometry & geometry,
                         std::uint64_t          maximumPoreSize,
                         const Survey &         survey)
  : m_Map(map)
  , m_Union(map, geometry, maximumPoreSize)
  , m_Survey(survey, m_Union.GetPiece())
{}

std::uint64_t
LabelMapRun::GetPlannedBytes(const LabelSelection & selection)
{
  return ObjectSurvey::BytesPerObject *
         (selection.all ? PlannedObjects : selection.values.size() + selection.names.size());
}

std::uint64_t
LabelMapRun::GetUnplannedBytes(const LabelSelection & selection, std::size_t numberOfObjects)
{
  const std::uint64_t bytes = ObjectSurvey::BytesPerObject * numberOfObjects;
  return bytes - std::min(bytes, GetPlannedBytes(selection));
}

void
LabelMapRun::AddMesh(SurfaceMesh & mesh)
{
  m_Mesh = &mesh;
  mesh.FindObjectsWith(
    [this](const itk::MedialVoxelIndex & cell) { return m_Union.GetPiece().FindOwner(cell, m_Pass); });
}

itk::MedialVoxelSums
LabelMapRun::Run(PieceLoop & loop, PieceEngine & engine, const SliceRange & piece, WriteBehind & writer)
{
  itk::MedialVoxelSums sums;
  m_Union.BeginPiece(piece);
  if (m_Mesh)
  {
    m_Mesh->SetObjectLabels(m_Map.GetTable().GetValues());
  }
  for (m_Pass = 0; m_Pass < m_Map.GetNumberOfPasses(); ++m_Pass)
  {
    m_Map.ShowPass(m_Pass);
    m_Union.BeginPass(m_Pass);
    m_Survey.SetPass(m_Pass);
    if (m_Mesh)
    {
      m_Mesh->BeginPass(m_Pass);
    }
    sums += loop.Run(engine, piece, {}, writer);
    writer.Wait();
    // The window shows the objects of this pass.
    engine.DropWindow();
  }
  m_Union.FinishPiece();
  return sums;
}

Json
LabelMapRun::Summarize() const
{
  return { { "passes", m_Map.GetNumberOfPasses() },
           { "shared_cells", m_Union.GetSharedCells() },
           { "objects", m_Survey.Summarize(m_Map) } };
}

} // end namespace medialvoxel
