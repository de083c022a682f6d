// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFineSheet.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

double
GetDistance(const MedialVoxelVector3 & a, const MedialVoxelVector3 & b)
{
  return MedialVoxelNorm(MedialVoxelSubtract(a, b));
}

} // namespace

MedialVoxelFineSheet::MedialVoxelFineSheet(MedialVoxelSheet sheet, const MedialVoxelElementSize & size)
  : m_Sheet(std::move(sheet))
  , m_Lines(MedialVoxelFindLines(m_Sheet))
  , m_Sizes(m_Sheet, m_Lines, size)
  , m_WallTree(m_Sheet.points, m_Sheet.triangles, m_Lines.wallOf)
{
  std::vector<MedialVoxelSheetTree::Triangle> segments;
  std::vector<Index>                          groups;
  for (const MedialVoxelSheetLines::Line & line : m_Lines.lines)
  {
    segments.push_back({ { line.points[0], line.points[1], line.points[1] } });
    groups.push_back(line.wall == MedialVoxelSheetLines::Junction ? 0 : 1 + line.wall);
  }
  m_LineTree = std::make_unique<MedialVoxelSheetTree>(m_Sheet.points, segments, groups);
}

Index
MedialVoxelFineSheet::GetNearestPoint(const Index triangle, const Point & place) const
{
  const auto & corners = m_Sheet.triangles[triangle];
  return *std::min_element(corners.begin(), corners.end(), [&](const Index a, const Index b) {
    return GetDistance(m_Sheet.points[a], place) < GetDistance(m_Sheet.points[b], place);
  });
}

double
MedialVoxelFineSheet::GetThickness(const Index triangle, const Point & place) const
{
  double sum = 0.0;
  double weights = 0.0;
  for (const Index corner : m_Sheet.triangles[triangle])
  {
    if (MedialVoxelIsKnown(m_Sheet.thickness[corner]))
    {
      // By the distance: the same as linear at the corners, and defined where some are unknown.
      const double weight = 1.0 / (GetDistance(m_Sheet.points[corner], place) + 1e-6 * this->GetMeanSide());
      sum += weight * m_Sheet.thickness[corner];
      weights += weight;
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

} // end namespace itk
