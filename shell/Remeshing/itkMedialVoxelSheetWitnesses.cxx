// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetWitnesses.h"

#include "itkMedialVoxelSheetTree.h"

#include <cassert>

namespace itk
{
namespace
{

/** A point this near to a triangle, of the tolerance, is not compared with others. */
constexpr double EnoughOfTolerance = 0.1;

double
GetDistance(const MedialVoxelVector3 & point, const MedialVoxelSheetWitnesses::Corners & corners)
{
  return MedialVoxelNorm(MedialVoxelSubtract(point, MedialVoxelNearestOfTriangle(point, corners)));
}

} // namespace

MedialVoxelSheetWitnesses::MedialVoxelSheetWitnesses(const std::vector<MedialVoxelVector3> & points)
  : m_Given(&points)
  , m_Next(points.size(), None)
{}

void
MedialVoxelSheetWitnesses::Add(const Index point, const Index triangle)
{
  if (triangle >= m_First.size())
  {
    m_First.resize(triangle + std::size_t{ 1 }, None);
  }
  m_Next[point] = m_First[triangle];
  m_First[triangle] = point;
}

void
MedialVoxelSheetWitnesses::AppendPoints(const Index triangle, std::vector<Index> & points) const
{
  for (Index point = triangle < m_First.size() ? m_First[triangle] : None; point != None; point = m_Next[point])
  {
    points.push_back(point);
  }
}

bool
MedialVoxelSheetWitnesses::Fit(const std::vector<Index> &   before,
                               const std::vector<Corners> & after,
                               const double                 tolerance)
{
  m_Points.clear();
  for (const Index triangle : before)
  {
    this->AppendPoints(triangle, m_Points);
  }
  m_Places.clear();
  const double enough = EnoughOfTolerance * tolerance;
  Index        last = 0;
  for (const Index point : m_Points)
  {
    double nearest = tolerance;
    Index  place = None;
    for (Index k = 0; k < after.size() && (place == None || nearest > enough); ++k)
    {
      // Points follow each other: that of the last one first.
      const Index  candidate = k == 0 ? last : k <= last ? k - 1 : k;
      const double distance = GetDistance((*m_Given)[point], after[candidate]);
      if (distance < nearest)
      {
        nearest = distance;
        place = candidate;
      }
    }
    if (place == None)
    {
      return false;
    }
    m_Places.push_back(place);
    last = place;
  }
  return true;
}

void
MedialVoxelSheetWitnesses::Assign(const std::vector<Index> & before, const std::vector<Index> & after)
{
  assert(m_Places.size() == m_Points.size());
  for (const Index triangle : before)
  {
    if (triangle < m_First.size())
    {
      m_First[triangle] = None;
    }
  }
  for (std::size_t k = 0; k < m_Points.size(); ++k)
  {
    this->Add(m_Points[k], after[m_Places[k]]);
  }
}

void
MedialVoxelSheetWitnesses::LeaveOut(const Index triangle)
{
  if (triangle < m_First.size())
  {
    m_First[triangle] = None;
  }
}

void
MedialVoxelSheetWitnesses::Share(const Index     triangle,
                                 const Index     half,
                                 const Corners & corners,
                                 const Corners & cornersOfHalf)
{
  this->Fit({ triangle }, { corners, cornersOfHalf }, MedialVoxelSheetTree::Anywhere);
  this->Assign({ triangle }, { triangle, half });
}

} // end namespace itk
