// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectSurvey.h"

#include "SurveySummary.h"

namespace medialvoxel
{

ObjectSurvey::ObjectSurvey(const Survey & survey, const itk::MedialVoxelObjectRegion & piece)
  : m_Survey(survey)
  , m_Piece(piece)
{}

void
ObjectSurvey::Begin()
{
  m_Pending.clear();
  m_Unknown.clear();
}

void
ObjectSurvey::Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace *)
{
  using WordType = itk::MedialVoxelBits::WordType;
  const std::lock_guard<std::mutex> lock(m_Mutex);
  Sums *                            sums = nullptr;
  ObjectNumber                      last = 0;
  const auto                        find = [&](const itk::MedialVoxelIndex & cell) {
    const ObjectNumber object = m_Piece.FindObject(cell, m_Pass);
    if (object != last)
    {
      last = object;
      sums = object > 0 ? &this->GetSums(m_Pending, object) : nullptr;
    }
    return sums;
  };
  for (const itk::MedialVoxelCellRow & row : tile.rows)
  {
    itk::MedialVoxelIndex cell = row.first;
    WordType              medial = row.byBound | row.byGeodesic;
    for (WordType rest = row.candidates; rest != 0; rest >>= 1, medial >>= 1, ++cell[0])
    {
      const bool isMedial = (medial & 1) != 0;
      if ((rest & 1) == 0)
      {
        continue;
      }
      if (Sums * const found = find(cell))
      {
        AddCell(*found, isMedial);
      }
      else
      {
        m_Unknown.push_back({ cell, isMedial, std::nullopt });
      }
    }
  }
  itk::MedialVoxelForEachWall(tile.rows, tile.walls, [&](const auto & cell, const auto & wall) {
    if (!m_Survey.GetSample().Contains(cell))
    {
      return;
    }
    if (Sums * const found = find(cell))
    {
      found->thickness.AddWall(wall, m_Survey.GetAreaUnit());
    }
    else
    {
      m_Unknown.push_back({ cell, true, wall });
    }
  });
}

void
ObjectSurvey::Commit()
{
  for (const Unknown & unknown : m_Unknown)
  {
    Sums & sums = this->GetSums(m_Pending, m_Piece.FindObjectOfPore(unknown.cell, m_Pass));
    if (unknown.wall)
    {
      sums.thickness.AddWall(*unknown.wall, m_Survey.GetAreaUnit());
    }
    else
    {
      AddCell(sums, unknown.isMedial);
    }
  }
  for (const auto & [object, sums] : m_Pending)
  {
    Sums & total = this->GetSums(m_Total, object);
    total.candidateCells += sums.candidateCells;
    total.medialCells += sums.medialCells;
    total.thickness.Add(sums.thickness);
  }
}

void
ObjectSurvey::AddCell(Sums & sums, bool isMedial)
{
  ++sums.candidateCells;
  sums.medialCells += isMedial ? 1 : 0;
}

Json
ObjectSurvey::Summarize(const itk::MedialVoxelObjectMap & map) const
{
  Json         objects = Json::array();
  const Sums   none(this->GetBinWidth());
  const auto & table = map.GetTable();
  for (std::size_t number = 1; number <= table.GetNumberOfObjects(); ++number)
  {
    const auto   object = static_cast<ObjectNumber>(number);
    const auto   found = m_Total.find(object);
    const Sums & sums = found == m_Total.end() ? none : found->second;
    objects.push_back({ { "label", table.GetValue(object) },
                        { "name", nullptr },
                        { "color", nullptr },
                        { "voxels", map.GetObjectVoxels()[number] },
                        { "candidate_cells", sums.candidateCells },
                        { "medial_cells", sums.medialCells },
                        { "thickness", MakeThickness(sums.thickness, m_Survey) } });
  }
  return objects;
}

auto
ObjectSurvey::GetSums(SumsByObject & sums, ObjectNumber object) const -> Sums &
{
  return sums.try_emplace(object, this->GetBinWidth()).first->second;
}

double
ObjectSurvey::GetBinWidth() const
{
  return m_Survey.GetSums().GetCells().GetBinWidth();
}

} // end namespace medialvoxel
