// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LabelMapRun.h"

namespace medialvoxel
{

LabelMapRun::LabelMapRun(LabelMap &             map,
                         const VolumeGeometry & geometry,
                         std::uint64_t          maximumPoreSize,
                         const Survey &         survey)
  : m_Map(map)
  , m_Union(map, geometry, maximumPoreSize)
  , m_Survey(survey, m_Union.GetPiece())
{}

itk::MedialVoxelSums
LabelMapRun::Run(PieceLoop & loop, PieceEngine & engine, const SliceRange & piece, WriteBehind & writer)
{
  itk::MedialVoxelSums sums;
  m_Union.BeginPiece(piece);
  for (unsigned int pass = 0; pass < m_Map.GetNumberOfPasses(); ++pass)
  {
    m_Map.ShowPass(pass);
    m_Union.BeginPass(pass);
    m_Survey.SetPass(pass);
    sums += loop.Run(engine, piece, {}, writer);
    writer.Wait();
    // The window shows the objects of this pass.
    engine.DropWindow();
  }
  m_Union.FinishPiece();
  return sums;
}

LabelMapSummary
LabelMapRun::Summarize() const
{
  return { m_Survey.Summarize(m_Map), m_Map.GetNumberOfPasses(), m_Union.GetSharedCells() };
}

} // end namespace medialvoxel
